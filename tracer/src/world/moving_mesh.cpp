#include "world/moving_mesh.hpp"

#include <cstring>

#include "embree_core/cell_callbacks.hpp"
#include "embree_core/rays.hpp"
#include "scene/meshes_alone.hpp"
#include "world/mesh_holes.hpp"

namespace phasetree::tracer {

namespace {

void bounds_of_moving_mesh(const RTCBoundsFunctionArguments* arguments) {
    embree::write_bounds(*arguments->bounds_o, static_cast<const MovingMesh*>(arguments->geometryUserPtr)->bounds());
}

// The direction is not normalised in the space of the mesh, so that distances remain those of the scene.
void intersect_moving_mesh(const RTCIntersectFunctionNArguments* arguments) noexcept {
    if (arguments->valid[0] != -1) return;
    const MovingMesh& mesh = *static_cast<const MovingMesh*>(arguments->geometryUserPtr);
    auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const Transform inward = mesh.at(ray.time).inverse();
    RTCRayHit inner =
        embree::rayhit_of(glm::vec3(inward({ray.org_x, ray.org_y, ray.org_z})),
                          glm::vec3(inward.matrix * glm::dvec3(ray.dir_x, ray.dir_y, ray.dir_z)), ray.tnear, ray.tfar);
    inner.ray.time = ray.time;
    embree::Context context;
    embree::initialise(context);
    embree::intersect(mesh.scene(), context, inner);
    if (!embree::is_hit(inner)) return;
    ray.tfar = inner.ray.tfar;
    hit = inner.hit;
}

}  // namespace

GeometryHandle triangles_of(RTCDevice device, const Mesh& mesh) {
    GeometryHandle geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    void* vertices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), mesh.vertices.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(glm::uvec3), mesh.triangles.size());
    std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(glm::vec3));
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    if (mesh.opacity) leave_holes(geometry.get(), mesh);
    rtcCommitGeometry(geometry.get());
    return geometry;
}

MovingMesh::MovingMesh(RTCDevice device, const Mesh& mesh, unsigned id)
    : mesh_(mesh), bounds_(mesh.motion.value().swept(bounds_of({&mesh, 1}))), scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometryByID(scene_.get(), triangles_of(device, mesh).get(), id);
    rtcCommitScene(scene_.get());
    geometry_.reset(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), 1);
    rtcSetGeometryUserData(geometry_.get(), this);
    rtcSetGeometryBoundsFunction(geometry_.get(), bounds_of_moving_mesh, nullptr);
    rtcSetGeometryIntersectFunction(geometry_.get(), intersect_moving_mesh);
    rtcCommitGeometry(geometry_.get());
}

}  // namespace phasetree::tracer
