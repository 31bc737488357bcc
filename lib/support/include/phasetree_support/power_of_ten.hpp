#pragma once

#include <cmath>
#include <numbers>

namespace phasetree::support {

/// The exponent of the largest power of ten that is at most x; the same on all processors. x must be positive and
/// finite.
inline int exponent_of_ten(double x) {
    int exponent = static_cast<int>(std::floor(std::log(x) / std::numbers::ln10));
    // Correct for rounding of the quotient of logarithms.
    if (std::pow(10.0, exponent + 1) <= x) ++exponent;
    if (std::pow(10.0, exponent) > x) --exponent;
    return exponent;
}

}  // namespace phasetree::support
