#pragma once

#include "bounding/enclosed_program.hpp"

namespace phasetree::bounding {

/// The range of every value of an enclosed program, with a margin for the rounding errors of floats.
struct ValueRanges {
    std::span<const float> lows, highs;
    std::span<const float> slope;  ///< a Lipschitz bound of each value in the box
    EnclosedProgram enclosed;
    double margin;  ///< an upper bound on the rounding error of one value

    float low(std::uint32_t i) const { return lows[i]; }
    float high(std::uint32_t i) const { return highs[i]; }
    /// Whether a − b > least is proven for the whole box: from the two ranges, from an enclosure of the difference, or,
    /// recursively up to `depth` levels, from the operands of minima and maxima.
    bool is_above(std::uint32_t a, std::uint32_t b, float least, int depth = 1) const;
};

}  // namespace phasetree::bounding
