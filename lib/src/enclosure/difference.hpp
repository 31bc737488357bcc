#pragma once

#include <algorithm>
#include <cmath>

#include "enclosure/number.hpp"

namespace phasetree::enclosure {

/// A lower bound on a − b in a box with the given half extents. It is the better of two bounds: one from the ranges of
/// the gradients, and one from the gradients at the centre and the bounds of curvature. Where one solid continues
/// another, their gradients are nearly the same, so the difference is known much more accurately than either value.
inline double least_difference(const Enclosure& a, const Enclosure& b, const Enclosure::Vector& half) {
    double by_gradient = 0, by_bend = 0, squared_half = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        by_gradient += (a.gradient[i] - b.gradient[i]).magnitude() * half[i];
        by_bend += std::abs(a.centre_gradient[i] - b.centre_gradient[i]) * half[i];
        squared_half += half[i] * half[i];
    }
    by_bend += 0.5 * std::max(b.curvature.high - a.curvature.low, 0.0) * squared_half;
    // by_bend is NaN if a gradient at the centre is unknown. The comparison is then false.
    return a.centre - b.centre - (by_bend < by_gradient ? by_bend : by_gradient);
}

}  // namespace phasetree::enclosure
