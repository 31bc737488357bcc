// How the estimates of several techniques for the same light are put together.
#pragma once

#include "sampling/heuristic.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// The weight of what was found by the technique which the setting `alone` leaves alone, of shadow rays and the path's
/// own directions. It was found with the density `pdf`; the other of the two would have found it with the density
/// `by_other`, and photons with `by_photons`. By the power heuristic, or 1 or 0 where one technique works alone.
inline float technique_weight(const Scene& scene, Techniques alone, float pdf, float by_other, float by_photons) {
    if (scene.settings.techniques == Techniques::all) return power_heuristic(pdf, by_other, by_photons);
    return scene.settings.techniques == alone ? 1.0f : 0.0f;
}

}  // namespace phasetree::tracer
