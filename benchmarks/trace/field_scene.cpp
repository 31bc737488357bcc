#include "trace/field_scene.hpp"

namespace phasetree::bench {

FieldScene::FieldScene(const Phased& object, PhaseSet opaque, BuildQuality quality)
    : FieldScene(std::make_shared<const InterfaceCells>(object, CellOptions{.quality = quality, .opaque = opaque}),
                 std::nullopt) {}

FieldScene::FieldScene(const FieldScene& object, float ground)
    : FieldScene(object.cells_, std::optional<float>(ground)) {}

FieldScene::FieldScene(std::shared_ptr<const InterfaceCells> cells, std::optional<float> ground)
    : cells_(std::move(cells)), scene_(RTC_SCENE_FLAG_ROBUST) {
    geometry_.emplace(scene_.device(), cells_, embree::CellGeometry::Options{.rays_carry_phases = true});
    rtcCommitGeometry(geometry_->handle());
    rtcAttachGeometryByID(scene_.handle(), geometry_->handle(), object_id);
    if (ground) add_ground(*ground);
    rtcCommitScene(scene_.handle());
}

void FieldScene::add_ground(float height) {
    const RTCGeometry geometry = rtcNewGeometry(scene_.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const glm::vec3 centre = cells_->bounds().centre();
    const float far = 30 * cells_->bounds().diagonal();
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 4));
    for (int i = 0; i < 4; ++i)
        vertices[i] = {centre.x + (i % 2 == 0 ? -far : far), centre.y + (i < 2 ? -far : far), height};
    auto* triangles = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), 2));
    triangles[0] = {0, 1, 3};
    triangles[1] = {0, 3, 2};
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.handle(), geometry, ground_id);
    rtcReleaseGeometry(geometry);
}

std::optional<FieldScene::Surface> FieldScene::surface(const Ray& ray) const {
    embree::Query query;
    const RTCRayHit hit = nearest(ray, query);
    if (!embree::is_hit(hit)) return std::nullopt;
    if (hit.hit.geomID == object_id) {
        const Crossing& c = query.crossing;
        const CrossingNormal normal = cells_->normal(hit.hit.primID, c, ray.direction);
        return Surface{c.t_from, c.p_from, -normal.unit, hit.hit.primID, c.from, normal.gradient};
    }
    const float up = ray.direction.z < 0 ? 1.f : -1.f;
    const glm::vec3 point = ray.origin + hit.ray.tfar * ray.direction;
    return Surface{hit.ray.tfar, point + glm::vec3(0, 0, up * 1e-5f * cells_->bounds().diagonal()), {0, 0, up}};
}

TraceCounters FieldScene::counters(std::span<const Ray> rays) const {
    const FlushSubnormals flush;
    TraceCounters all;
    for (const Ray& ray : rays) {
        embree::Query query;
        nearest(ray, query);
        all.visits += query.counters.visits;
        all.batches += query.counters.batches;
        all.phantoms += query.counters.phantoms;
    }
    return all;
}

}  // namespace phasetree::bench
