#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "phasetree/program/program.hpp"

namespace phasetree::enclosure {
struct Enclosure;
}

namespace phasetree::bounding {

using enclosure::Enclosure;

/// Bounds of every instruction's value in a box, and of its slope there; and the enclosures that they are of, which
/// know differences better.
struct ValueRanges {
    std::span<const float> lows, highs, slope;
    std::span<const Instruction> code;
    const Enclosure* registers;
    std::span<const std::uint32_t> slot;
    std::array<double, 3> half;  ///< the box's half extents
    double margin;               ///< of a value

    float low(std::uint32_t i) const { return lows[i]; }
    float high(std::uint32_t i) const { return highs[i]; }
    /// Whether a − b > least throughout. Minima and maxima are looked into that many deep.
    bool is_above(std::uint32_t a, std::uint32_t b, float least, int depth = 1) const;
};

}  // namespace phasetree::bounding
