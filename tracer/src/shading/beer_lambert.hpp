// The Beer-Lambert law: the part of the radiance left after `distance` in a medium that absorbs `absorption` per unit
// length, T = exp(−a d). The unit of length is the scene's.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

inline glm::vec3 transmittance(const glm::vec3& absorption, float distance) {
    // A medium that does not absorb passes everything, also over an infinite distance (where 0·∞ is not a number).
    const auto channel = [distance](float a) { return a > 0.0f ? std::exp(-a * distance) : 1.0f; };
    return {channel(absorption.x), channel(absorption.y), channel(absorption.z)};
}

}  // namespace phasetree::tracer
