// How the estimates of several techniques for the same light are put together.
#pragma once

#include "sampling/heuristic.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// A technique by which a path finds light by itself.
enum class Technique { shadow_rays, directions };

/// The weight of light that one technique found, with the density `pdf`; the other of the two would have found it with
/// the density `by_other`, and photons with `by_photons`. By the power heuristic, or 1 or 0 where one works alone.
inline float technique_weight(Techniques at_work, Technique found_by, float pdf, float by_other, float by_photons) {
    switch (at_work) {
        case Techniques::shadow_rays_alone:
            return found_by == Technique::shadow_rays ? 1.0f : 0.0f;
        case Techniques::directions_alone:
            return found_by == Technique::directions ? 1.0f : 0.0f;
        case Techniques::all:
            break;
    }
    return power_heuristic(pdf, by_other, by_photons);
}

}  // namespace phasetree::tracer
