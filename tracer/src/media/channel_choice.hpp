// Chooses the colour channel by which the next distance of a path is sampled.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// The probability of each channel: proportional to the path's throughput, so that channels with little light have
/// little influence; uniform if the throughput is 0.
inline glm::vec3 channel_choice(const glm::vec3& throughput) {
    const glm::vec3 positive(std::max(throughput.x, 0.0f), std::max(throughput.y, 0.0f), std::max(throughput.z, 0.0f));
    const float sum = positive.x + positive.y + positive.z;
    return sum > 0.0f ? positive / sum : glm::vec3(1.0f / 3.0f);
}

/// The channel chosen by u in [0, 1); never one with probability 0.
inline int channel_at(const glm::vec3& choice, float u) {
    if (u < choice.x) return 0;
    if (u < choice.x + choice.y) return 1;
    return choice.z > 0.0f ? 2 : choice.y > 0.0f ? 1 : 0;
}

}  // namespace phasetree::tracer
