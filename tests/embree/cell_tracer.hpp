#pragma once

/// A tracer through Embree and cells, with the interface that support/crossing_checks.hpp requires.

#include <memory>
#include <optional>

#include "embree_core/cell_geometry.hpp"

namespace phasetree::tests {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

class CellTracer {
  public:
    struct Hit : Crossing {
        unsigned cell = 0;
        CrossingNormal normal{};
    };

    CellTracer(RTCDevice device, const Phased& object, BuildQuality quality)
        : cells_(std::make_shared<const InterfaceCells>(object, CellOptions{.quality = quality})),
          geometry_(device, cells_, {.rays_carry_phases = true}),
          scene_(rtcNewScene(device)) {
        rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
        rtcCommitGeometry(geometry_.handle());
        rtcAttachGeometryByID(scene_.get(), geometry_.handle(), 0);
        rtcCommitScene(scene_.get());
    }

    std::optional<Hit> first_crossing(const glm::vec3& o, const glm::vec3& d, float length, Phase carried,
                                      const Hit* start, TraceCounters& counters) const {
        embree::Query query;
        query.default_phase = carried;
        if (start) query.start = {embree::ObjectInstance{0}, start->cell, start->from, start->normal.gradient};
        RTCRayHit ray = embree::rayhit_of(o, d, 0, length);
        embree::intersect(scene_.get(), query.context, ray);
        counters = query.counters;
        if (!embree::is_hit(ray)) return std::nullopt;
        return Hit{query.crossing, ray.hit.primID, cells_->normal(ray.hit.primID, query.crossing, d)};
    }
    glm::vec3 normal(const Hit& hit, const glm::vec3& d) const { return cells_->normal(hit.cell, hit, d).unit; }
    Phase label(const glm::vec3& p) const { return cells_->label(p, Evaluator::thread_workspace()); }
    Bounds bounds() const { return cells_->bounds(); }
    float resolution() const { return cells_->resolution(); }
    const InterfaceCells& cells() const { return *cells_; }

  private:
    std::shared_ptr<const InterfaceCells> cells_;
    embree::CellGeometry geometry_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
};

}  // namespace phasetree::tests
