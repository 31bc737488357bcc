#include "trace/mesh_scene.hpp"

#include <cstring>

namespace phasetree::bench {

MeshScene::MeshScene(const Triangles& mesh, RTCBuildQuality quality) : scene_(RTC_SCENE_FLAG_NONE) {
    const RTCGeometry geometry = rtcNewGeometry(scene_.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             mesh.vertices.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                              mesh.triangles.size());
    std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(glm::vec3));
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.handle(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_.handle(), quality);
    rtcCommitScene(scene_.handle());
}

}  // namespace phasetree::bench
