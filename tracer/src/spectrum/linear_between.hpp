// Linear interpolation in a table of evenly spaced values, constant beyond both ends.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace phasetree::tracer {

/// The value at a position, in steps from the first value: 1.5 is halfway between the second and the third. T is
/// double, or a vector of doubles.
template <class T, std::size_t count>
T linear_between(const std::array<T, count>& values, double position) {
    position = std::clamp(position, 0.0, static_cast<double>(count - 1));
    const std::size_t below = std::min(static_cast<std::size_t>(position), count - 2);
    const double part = position - static_cast<double>(below);
    return (1.0 - part) * values[below] + part * values[below + 1];
}

}  // namespace phasetree::tracer
