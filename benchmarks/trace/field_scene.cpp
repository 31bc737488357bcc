#include "trace/field_scene.hpp"

namespace phasetree::bench {

FieldScene::FieldScene(const Phased& object)
    : cells_(std::make_shared<const InterfaceCells>(object)), scene_(RTC_SCENE_FLAG_ROBUST) {
    geometry_.emplace(scene_.device(), cells_, embree::Options{.rays_carry_phases = true});
    rtcCommitGeometry(geometry_->handle());
    rtcAttachGeometryByID(scene_.handle(), geometry_->handle(), 0);
    rtcCommitScene(scene_.handle());
}

TraceCounters FieldScene::counters(std::span<const Ray> rays) const {
    const FlushSubnormals flush;
    TraceCounters all;
    for (const Ray& ray : rays) {
        embree::Query query;
        nearest(ray, query);
        all.rays += query.counters.rays;
        all.batches += query.counters.batches;
        all.phantoms += query.counters.phantoms;
    }
    return all;
}

}  // namespace phasetree::bench
