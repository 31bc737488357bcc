// When a box is worth dividing: the more there are of its size, the more each of them has to save.
#pragma once

#include <algorithm>

#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// The share of what a box's rays need at least (price.hpp) that dividing it must promise to save. `size` is the box's
/// diagonal over the object's. Small boxes must save more: along an interface there are as many as the square of how
/// small they are, all of them are built, and few rays meet any one. How fast that grows is measured
/// (benchmarks/README.md).
inline float least_gain(BuildQuality quality, float size) {
    const float medium = 0.3f * (1 + 0.1f / size);
    if (quality == BuildQuality::medium) return medium;
    const float small = 0.04f / size, square = small * small;
    return std::max(medium, 0.5f * (1 + square * square));
}

}  // namespace phasetree
