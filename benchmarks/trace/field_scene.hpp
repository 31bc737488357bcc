// An object as the path tracer has it: interface cells as one user geometry of an Embree scene, rays that carry phases.
#pragma once

#include "embree_core/cell_geometry.hpp"
#include "trace/embree_scene.hpp"
#include "trace/many.hpp"

namespace phasetree::bench {

class FieldScene {
  public:
    // `opaque` and `quality`: see CellOptions.
    explicit FieldScene(const Phased& object, PhaseSet opaque = {}, BuildQuality quality = BuildQuality::medium);
    // The same cells, beside two large triangles at a height.
    FieldScene(const FieldScene& object, float ground);

    // The nearest change of phase, of a scene without ground; as tracer/src/world/traced_geometry.cpp asks for it.
    std::optional<Crossing> intersect(const Ray& ray) const {
        embree::Query query;
        const RTCRayHit hit = nearest(ray, query);
        if (!embree::is_hit(hit)) return std::nullopt;
        return query.crossing;
    }
    struct HitWithNormal {
        Crossing crossing;
        CrossingNormal normal;
        unsigned cell;
    };
    std::optional<HitWithNormal> intersect_with_normal(const Ray& ray) const {
        embree::Query query;
        const RTCRayHit hit = nearest(ray, query);
        if (!embree::is_hit(hit)) return std::nullopt;
        return HitWithNormal{query.crossing, cells_->normal(hit.hit.primID, query.crossing, ray.direction),
                             hit.hit.primID};
    }
    // The nearest surface, the ground among them, and where a reflected ray starts from it.
    struct Surface {
        float distance;
        glm::vec3 point, normal;  // against the ray
        std::optional<unsigned> cell{};
        Phase from{};
        glm::vec3 gradient{0};
    };
    std::optional<Surface> surface(const Ray& ray) const;
    Checksum trace(std::span<const Ray> rays, int threads) const {
        return trace_many(rays, threads, [this](const Ray& ray) -> std::optional<float> {
            const auto crossing = intersect(ray);
            if (!crossing) return std::nullopt;
            return crossing->t_from;
        });
    }
    TraceCounters counters(std::span<const Ray> rays) const;

    const InterfaceCells& cells() const { return *cells_; }
    CellStatistics statistics() const { return cells_->statistics(); }
    std::size_t embree_bytes() const { return scene_.bytes(); }
    std::size_t bytes() const { return statistics().bytes + embree_bytes(); }

  private:
    static constexpr unsigned object_id = 0, ground_id = 1;

    FieldScene(std::shared_ptr<const InterfaceCells> cells, std::optional<float> ground);
    void add_ground(float height);
    RTCRayHit nearest(const Ray& ray, embree::Query& query) const {
        RTCRayHit hit = rayhit_of(ray);
        query.default_phase = ray.carried;
        if (ray.cell) query.start = {embree::ObjectInstance{object_id}, *ray.cell, ray.from, ray.gradient};
        embree::intersect(scene_.handle(), query.context, hit);
        return hit;
    }

    std::shared_ptr<const InterfaceCells> cells_;
    std::optional<embree::CellGeometry> geometry_;  // made with the scene's device, and outlives the scene
    EmbreeScene scene_;
};

}  // namespace phasetree::bench
