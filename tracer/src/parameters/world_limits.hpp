// Limits on positions and sizes. Rays from beyond Embree's limit of 1.8·10¹⁸ end the program, and differences of
// coordinates lose all digits long before that.
#pragma once

#include "phasetree/model/parameter.hpp"

namespace phasetree::tracer {

inline constexpr float farthest = 1e15f;
inline constexpr Limits coordinate{.low = -farthest, .high = farthest};
inline constexpr Limits extent{.low = 0, .high = farthest, .low_open = true};

}  // namespace phasetree::tracer
