#include "world/mesh_holes.hpp"

#include <bit>
#include <cstdint>

#include "sampling/hash.hpp"
#include "world/mesh_place.hpp"

namespace phasetree::tracer {

namespace {

// Whether the mesh stops the ray there.
bool stops(const Mesh& mesh, const RTCRay& ray, const RTCHit& hit) {
    const MeshPlace met{mesh, hit.primID, hit.u, hit.v};
    const float opacity = mesh.opacity->at(TexturePoint(met.point(), {0, 0, 1}, met.coordinates()));
    if (opacity >= 1.0f) return true;
    if (!(opacity > 0.0f)) return false;
    const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
    return hash_to_unit(hash(bits(ray.org_x), bits(ray.org_y), bits(ray.org_z), bits(ray.dir_x), bits(ray.dir_y),
                             bits(ray.dir_z), hit.primID, hit.geomID)) < opacity;
}

// Embree's filter: what it makes 0 in `valid` is no hit.
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
    rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));  // it is only read
    rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
}

}  // namespace phasetree::tracer
