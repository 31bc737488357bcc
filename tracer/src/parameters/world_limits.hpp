// Where things may be and how large. Rays from farther than Embree's 1.8·10¹⁸ end the program there, and differences of
// coordinates have no digits left long before.
#pragma once

#include "phasetree/model/parameter.hpp"

namespace phasetree::tracer {

inline constexpr float farthest = 1e15f;
inline constexpr Limits coordinate{.low = -farthest, .high = farthest};
inline constexpr Limits extent{.low = 0, .high = farthest, .low_open = true};

}  // namespace phasetree::tracer
