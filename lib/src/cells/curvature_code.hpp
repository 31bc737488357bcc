#pragma once

#include <bit>
#include <cstdint>

#include "kernel/linear_bound.hpp"

namespace phasetree::cells {

using kernel::Curvature;

/// A bound of curvature in eight bits, rounded up by an eighth at most. The code is a float's exponent and the upper
/// three bits of its fraction, of the curvature times the object's diagonal. 0 is no curvature, 255 an unknown one. A
/// bound below 2⁻¹⁰/diagonal is rounded up to that, and one that is too large for the code becomes unknown.
class CurvatureCode {
  public:
    static constexpr std::uint8_t unknown = 255;

    explicit CurvatureCode(float diagonal = 1) : diagonal_(diagonal), inverse_diagonal_(1 / diagonal) {}

    std::uint8_t encode(float curvature) const {
        if (!(curvature > 0)) return 0;
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
