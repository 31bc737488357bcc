// How the estimates of several techniques for the same light are put together.
#pragma once

#include "sampling/heuristic.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// The weight of what one technique found with the density `pdf`, and others would have found with theirs: by the power
/// heuristic, or 1 or 0 where one of them works alone.
inline float technique_weight(const Scene& scene, Techniques own, float pdf, float other, float by_photons) {
    if (scene.settings.techniques == Techniques::all) return power_heuristic(pdf, other, by_photons);
    return scene.settings.techniques == own ? 1.0f : 0.0f;
}

}  // namespace phasetree::tracer
