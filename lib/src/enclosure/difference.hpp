#pragma once

#include <algorithm>
#include <cmath>

#include "enclosure/number.hpp"

namespace phasetree::enclosure {

/// What a − b is at least in a box of these half extents, by their gradients' ranges or by the gradients at the centre
/// and how both bend from there on. Of solids that continue each other the gradients are nearly the same, and the
/// difference is known far better than either value.
inline double least_difference(const Enclosure& a, const Enclosure& b, const Enclosure::Vector& half) {
    double by_gradient = 0, by_bend = 0, squared_half = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        by_gradient += (a.gradient[i] - b.gradient[i]).magnitude() * half[i];
        by_bend += std::abs(a.centre_gradient[i] - b.centre_gradient[i]) * half[i];
        squared_half += half[i] * half[i];
    }
    by_bend += 0.5 * std::max(b.curvature.high - a.curvature.low, 0.0) * squared_half;
    return a.centre - b.centre - (by_bend < by_gradient ? by_bend : by_gradient);
}

}  // namespace phasetree::enclosure
