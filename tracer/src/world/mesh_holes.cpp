#include "world/mesh_holes.hpp"

#include <cstdint>

#include "sampling/hash.hpp"
#include "world/mesh_place.hpp"
#include "world/triangle_hit.hpp"

namespace phasetree::tracer {

namespace {

// Whether the mesh stops the ray there. If the mesh moves, the ray is in the space of the mesh as it is stored.
bool stops(const Mesh& mesh, const RTCRay& ray, RTCHit hit) {
    float distance = 0;
    recompute_hit(mesh, ray, hit, distance);
    MeshPlace met{mesh, hit.primID, hit.u, hit.v};
    if (mesh.motion) met.moved = mesh.motion->at(static_cast<double>(ray.time));
    const float opacity = mesh.opacity->at(TexturePoint(met.point(), {0, 0, 1}, met.coordinates()));
    if (opacity >= 1.0f) return true;
    if (!(opacity > 0.0f)) return false;
    const std::uint32_t of_direction = hash_of({ray.dir_x, ray.dir_y, ray.dir_z}, hit.primID, hit.geomID);
    return hash_to_unit(hash_of({ray.org_x, ray.org_y, ray.org_z}, of_direction)) < opacity;
}

// Embree's filter: entries of `valid` that it sets to 0 are not hits.
void pass_holes(const RTCFilterFunctionNArguments* arguments) noexcept {
    const Mesh& mesh = *static_cast<const Mesh*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const RTCRay ray = rtcGetRayFromRayN(arguments->ray, arguments->N, i);
        const RTCHit hit = rtcGetHitFromHitN(arguments->hit, arguments->N, i);
        if (!stops(mesh, ray, hit)) arguments->valid[i] = 0;
    }
}

}  // namespace

void leave_holes(RTCGeometry geometry, const Mesh& mesh) {
    rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));  // never modified
    rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
}

}  // namespace phasetree::tracer
