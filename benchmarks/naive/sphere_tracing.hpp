// The paper's way on the CPU: the tree is walked with arrays of phases at every step of sphere tracing (Section 7.3),
// one ray and one point at a time, and the whole object is one primitive of Embree.
#pragma once

#include "phasetree/cells/cells.hpp"
#include "trace/embree_scene.hpp"
#include "trace/many.hpp"

namespace phasetree::bench {

// How far a step may go. Both are safe.
enum class Step {
    least_magnitude,     // minᵢ |φᵢ| over the phases, as in the paper; of φ₀ too, which it derives from them
    interface_distance,  // the second smallest component, vacuum included: at least as long
};

class NaiveScene {
  public:
    // The bounds are those of the cells, and so is the resolution at which a change of label counts as found.
    NaiveScene(const Phased& object, const Bounds& bounds, float resolution, Step step);
    ~NaiveScene();

    struct Hit {
        float distance = 0;
        Phase to;
    };
    std::optional<Hit> intersect(const Ray& ray) const {
        RTCRayHit hit = rayhit_of(ray);
        embree::Context context;
        embree::initialise(context);
        embree::intersect(scene_.handle(), context, hit);
        if (!embree::is_hit(hit)) return std::nullopt;
        return Hit{hit.ray.tfar, Phase{static_cast<std::uint8_t>(hit.hit.u)}};
    }
    Checksum trace(std::span<const Ray> rays, int threads) const {
        return trace_many(rays, threads, [this](const Ray& ray) -> std::optional<float> {
            const auto hit = intersect(ray);
            if (!hit) return std::nullopt;
            return hit->distance;
        });
    }

    struct Object {
        Phased tree;
        Bounds bounds;
        float resolution = 0;
        Step step = Step::interface_distance;
    };

  private:
    std::unique_ptr<const Object> object_;  // its address is the callbacks'
    EmbreeScene scene_;
    RTCGeometry geometry_ = nullptr;
};

}  // namespace phasetree::bench
