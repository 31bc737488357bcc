#pragma once

#include <cmath>
#include <numbers>

namespace phasetree::support {

/// The exponent of the largest power of ten that is at most x, which is positive and finite. The same on all
/// processors.
inline int exponent_of_ten(double x) {
    int exponent = static_cast<int>(std::floor(std::log(x) / std::numbers::ln10));
    // The quotient of logarithms is rounded.
    if (std::pow(10.0, exponent + 1) <= x) ++exponent;
    if (std::pow(10.0, exponent) > x) --exponent;
    return exponent;
}

}  // namespace phasetree::support
