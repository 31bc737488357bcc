// When a box is worth dividing: the more there are of its size, the more each of them has to save.
#pragma once

#include <algorithm>

#include "phasetree/building/options.hpp"

namespace phasetree::building {

/// The share of what a box's rays need at least (price.hpp) that dividing it must promise to save. `size` is the box's
/// diagonal over the object's. Small boxes must save more: along an interface there are as many as the square of how
/// small they are, all of them are built, and few rays meet any one. How fast that grows is measured
/// (benchmarks/experiments.md): faster where more than two phases meet, `is_meeting`, and fastest if the first one's
/// distance is well known there, `is_first_known`. What is saved then are mostly rays in the other phases, which prices
/// take to be in the dark.
inline float least_gain(BuildQuality quality, float size, bool is_meeting, bool is_first_known) {
    const auto fourth_power = [&](float large, float small) {
        const float square = (small / size) * (small / size);
        return large * (1 + square * square);
    };
    const float all = (is_meeting ? 0.35f : 0.3f) * (1 + 0.1f / size);
    const float medium = is_meeting && is_first_known ? std::max(all, fourth_power(0.1f, 0.028f)) : all;
    return quality == BuildQuality::medium ? medium : std::max(medium, fourth_power(0.5f, 0.04f));
}

}  // namespace phasetree::building
