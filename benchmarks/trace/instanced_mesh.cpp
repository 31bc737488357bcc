#include "trace/instanced_mesh.hpp"

#include <glm/geometric.hpp>

namespace phasetree::bench {

InstancedMesh::InstancedMesh(const Triangles& mesh, std::span<const glm::mat4x3> places)
    : mesh_(mesh, RTC_BUILD_QUALITY_MEDIUM), places_(rtcNewScene(mesh_.device())) {
    rtcSetSceneFlags(places_.get(), RTC_SCENE_FLAG_NONE);
    for (const glm::mat4x3& place : places) {
        const RTCGeometry instance = rtcNewGeometry(mesh_.device(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, mesh_.handle());
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &place[0][0]);
        rtcCommitGeometry(instance);
        rtcAttachGeometry(places_.get(), instance);
        rtcReleaseGeometry(instance);
    }
    rtcCommitScene(places_.get());
}

std::optional<MeshScene::Hit> InstancedMesh::intersect(const Ray& ray) const {
    RTCRayHit hit = rayhit_of(ray);
    embree::Context context;
    embree::initialise(context);
    embree::intersect(places_.get(), context, hit);
    if (!embree::is_hit(hit)) return std::nullopt;
    float to_scene[16];
    rtcGetGeometryTransform(rtcGetGeometry(places_.get(), hit.hit.instID[0]), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            to_scene);
    // It turns and moves, so that normals go where vectors do.
    const glm::mat3 turn(to_scene[0], to_scene[1], to_scene[2], to_scene[3], to_scene[4], to_scene[5], to_scene[6],
                         to_scene[7], to_scene[8]);
    return MeshScene::Hit{hit.ray.tfar, turn * glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z)};
}

}  // namespace phasetree::bench
