// A medium that absorbs and does not scatter. By the Beer-Lambert law, its transmittance over a distance d is T =
// exp(−a d), with the absorption a in each colour channel.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "media/absorption.hpp"
#include "media/contract.hpp"

namespace phasetree::tracer {

/// The transmittance over a distance, which may be infinite, for a coefficient per unit length in each channel.
inline glm::vec3 beer_lambert(const glm::vec3& coefficient, float distance) {
    // A medium that does not absorb has transmittance 1 over an infinite distance, too, where 0·∞ would be NaN.
    const auto channel = [distance](float a) { return a > 0.0f ? std::exp(-a * distance) : 1.0f; };
    return {channel(coefficient.x), channel(coefficient.y), channel(coefficient.z)};
}

struct AbsorbingMedium {
    Absorption absorption{};  ///< a, per unit of length of the scene

    glm::vec3 transmittance(const Way& way, Sampler&) const {
        return beer_lambert(absorption.for_light(way.wavelengths), way.length);
    }
};

}  // namespace phasetree::tracer
