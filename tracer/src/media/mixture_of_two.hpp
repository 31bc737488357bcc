// Evaluates and samples a mixture of two phase functions. `share` is that of the second, from 0 to 1.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

inline float mixed(float share, float first, float second) {
    return (1.0f - share) * first + share * second;
}

/// Chooses one by the first random number, and rescales that number for its direction.
template <class First, class Second>
glm::vec3 sample_of_two(float share, const glm::vec2& u, const First& first, const Second& second) {
    constexpr float greatest = 0x1.fffffep-1f;
    if (u.x < share) return second.sample({std::min(u.x / share, greatest), u.y});
    return first.sample({std::min((u.x - share) / (1.0f - share), greatest), u.y});
}

}  // namespace phasetree::tracer
