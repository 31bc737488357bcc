// MIS weights of the techniques that find the same light.
#pragma once

#include "sampling/heuristic.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// A technique by which a path itself finds light: by shadow rays, or in the directions that it samples from the BSDF,
/// a guide or the phase function.
enum class Technique { shadow_rays, directions };

/// The weight of light that one technique found with `pdf`. The other one would have found it with `by_other`, and
/// photons with `by_photons`. Uses the power heuristic, or 1 or 0 if only one technique is enabled.
inline float technique_weight(Techniques enabled, Technique found_by, float pdf, float by_other, float by_photons) {
    switch (enabled) {
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
