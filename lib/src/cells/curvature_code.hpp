#pragma once

#include <bit>
#include <cstdint>

#include "kernel/linear_bound.hpp"

namespace phasetree::cells {

using kernel::Curvature;

/// Encodes an upper bound on curvature in eight bits, rounding up by at most an eighth. The code is the exponent and
/// the upper three fraction bits of the float (curvature · the object's diagonal). Code 0 means no curvature, 255
/// unknown. Bounds below 2⁻¹⁰/diagonal are rounded up to that value; bounds too large for the code become unknown.
class CurvatureCode {
  public:
    static constexpr std::uint8_t unknown = 255;

    explicit CurvatureCode(float diagonal = 1) : diagonal_(diagonal), inverse_diagonal_(1 / diagonal) {}

    std::uint8_t encode(float curvature) const {
        if (curvature <= 0) return 0;  // NaN becomes unknown
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(curvature * diagonal_ * (1 + 1e-6f));
        const std::uint32_t rounded_up = (bits + ((1u << dropped_bits) - 1)) >> dropped_bits;
        if (rounded_up >= smallest + 254) return unknown;
        return static_cast<std::uint8_t>(rounded_up <= smallest ? 1 : rounded_up - smallest + 1);
    }
    float decode(std::uint32_t code) const {
        if (code == 0) return 0;
        if (code == unknown) return Curvature::unknown;
        return std::bit_cast<float>((smallest + code - 1) << dropped_bits) * inverse_diagonal_;
    }

  private:
    static constexpr int dropped_bits = 20;
    static constexpr std::uint32_t smallest = (127 - 10) << 3;  ///< the upper bits of the float 2⁻¹⁰
    float diagonal_, inverse_diagonal_;
};

}  // namespace phasetree::cells
