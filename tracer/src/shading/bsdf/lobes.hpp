// Helpers of BSDFs that choose among several lobes.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// The weight of a coloured lobe in the choice.
inline float mean_of_channels(const glm::vec3& v) {
    return (v.x + v.y + v.z) / 3.0f;
}

/// Rescales a number in [low, high) to [0, 1), to reuse a random number after a choice among lobes.
inline float stretched(float u, float low, float high) {
    return high > low ? std::clamp((u - low) / (high - low), 0.0f, 0x1.fffffep-1f) : 0.0f;
}

}  // namespace phasetree::tracer
