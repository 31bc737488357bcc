#pragma once

#include <bit>
#include <cstdint>

#include "kernel/linear_bound.hpp"

namespace phasetree::cells {

using kernel::Curvature;

/// A curvature in eight bits, rounded up by an eighth at most: a float's exponent and the upper three bits of its
/// fraction, times what makes it independent of the object's size. 0 is no curvature, 255 an unknown one.
class CurvatureCode {
  public:
    static constexpr std::uint8_t unknown = 255;

    explicit CurvatureCode(float diagonal = 1) : to_code_(diagonal), from_code_(1 / diagonal) {}

    std::uint8_t encode(float curvature) const {
        if (!(curvature > 0)) return 0;
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(curvature * to_code_ * (1 + 1e-6f));
        const std::uint32_t up = (bits + ((1u << shift) - 1)) >> shift;
        if (up >= first + 254) return unknown;
        return static_cast<std::uint8_t>(up <= first ? 1 : up - first + 1);
    }
    float decode(std::uint32_t code) const {
        if (code == 0) return 0;
        if (code == unknown) return Curvature::unknown;
        return std::bit_cast<float>((first + code - 1) << shift) * from_code_;
    }

  private:
    static constexpr int shift = 20;
    static constexpr std::uint32_t first = (127 - 10) << 3;  ///< stands for 2⁻¹⁰ of the object's diagonal's inverse
    float to_code_, from_code_;
};

}  // namespace phasetree::cells
