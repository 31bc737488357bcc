// What BSDFs of several lobes share in choosing one of them.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// The number in proportion to which a lobe of several colours is chosen.
inline float mean_of_channels(const glm::vec3& v) {
    return (v.x + v.y + v.z) / 3.0f;
}

/// A number in [low, high), stretched to [0, 1): what is left of a random number after a choice among lobes.
inline float stretched(float u, float low, float high) {
    return high > low ? std::clamp((u - low) / (high - low), 0.0f, 0x1.fffffep-1f) : 0.0f;
}

}  // namespace phasetree::tracer
