#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "enclosure/enclosure.hpp"

namespace phasetree::bounding {

using enclosure::Enclosure, enclosure::Interval;

/// A linear function and an upper bound on the deviation of a field f from it in a box:
///     |f(p) − (at_centre + normal·(p − centre))| ≤ slack.
/// It is a LinearBound in doubles, relative to the box's centre. There are two ways to find it, and the one with the
/// smaller slack is chosen. One is the mean value theorem, with the middle of the gradient's range as the normal. The
/// other is Taylor's formula of first order, with the gradient at the centre and the bounds of the second derivative.
/// If nothing is known about the gradient, the slack is infinite.
struct NearlyLinear {
    Enclosure::Vector normal{};
    double at_centre, slack;
    bool is_by_curvature = false;  ///< whether Taylor's formula was used

    /// `half` contains the box's half extents.
    NearlyLinear(const Enclosure& f, const Enclosure::Vector& half) : at_centre(f.centre), slack(0) {
        double by_gradient = 0, squared_half = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Interval& g = f.gradient[i];
            const double at = f.centre_gradient[i];
            if (!(g.low <= g.high && g.high - g.low < 1e30)) {
                slack = std::numeric_limits<double>::infinity();
                return;
            }
            normal[i] = g.middle();
            slack += 0.5 * (g.high - g.low) * half[i];
            by_gradient += std::max(std::abs(g.high - at), std::abs(g.low - at)) * half[i];
            squared_half += half[i] * half[i];
        }
        const double above = std::min(by_gradient, 0.5 * std::max(f.curvature.high, 0.0) * squared_half);
        const double below = std::min(by_gradient, 0.5 * std::max(-f.curvature.low, 0.0) * squared_half);
        if (!(0.5 * (above + below) < slack)) return;
        is_by_curvature = true;
        normal = f.centre_gradient;
        at_centre += 0.5 * (above - below);
        slack = 0.5 * (above + below);
    }
    /// An upper bound on the distance of the gradient from the normal.
    double spread(const Enclosure& f, const Enclosure::Vector& half) const {
        double squared = 0, squared_half = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Interval& g = f.gradient[i];
            const double off = std::max(std::abs(g.high - normal[i]), std::abs(g.low - normal[i]));
            squared += off * off;
            squared_half += half[i] * half[i];
        }
        const double farthest = std::sqrt(squared);
        return is_by_curvature ? std::min(farthest, f.curvature.magnitude() * std::sqrt(squared_half)) : farthest;
    }
};

/// Narrows the value's range to what a linear bound allows in a box with these half extents.
inline void tighten_by_linear_bound(Enclosure& f, const Enclosure::Vector& half) {
    const NearlyLinear linear(f, half);
    double half_width = linear.slack;
    for (std::size_t i = 0; i < 3; ++i) half_width += std::abs(linear.normal[i]) * half[i];
    if (!(half_width < 1e30)) return;
    const double low = std::max(f.value.low, linear.at_centre - half_width);
    const double high = std::min(f.value.high, linear.at_centre + half_width);
    f.value = {std::min(low, high), std::max(low, high)};  // see Enclosure::tighten()
}

}  // namespace phasetree::bounding
