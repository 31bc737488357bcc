// The choice of the colour channel by which a path's next distance is sampled.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// The probability of each channel: in proportion to the path's throughput, so that what is nearly black decides
/// nothing; alike where there is none.
inline glm::vec3 channel_choice(const glm::vec3& throughput) {
    const glm::vec3 positive(std::max(throughput.x, 0.0f), std::max(throughput.y, 0.0f), std::max(throughput.z, 0.0f));
    const float sum = positive.x + positive.y + positive.z;
    return sum > 0.0f ? positive / sum : glm::vec3(1.0f / 3.0f);
}

/// The channel that u in [0, 1) falls into; never one of probability 0.
inline int channel_at(const glm::vec3& choice, float u) {
    if (u < choice.x) return 0;
    if (u < choice.x + choice.y) return 1;
    return choice.z > 0.0f ? 2 : choice.y > 0.0f ? 1 : 0;
}

}  // namespace phasetree::tracer
