#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "enclosure/enclosure.hpp"

namespace phasetree::bounding {

using enclosure::Enclosure, enclosure::Range;

/// As LinearBound, but about the centre of a box, and in numbers of full length. By the ranges of the gradient about
/// their middles; or by the gradient at the centre and how f bends from there on, if that says more. Where nothing is
/// known of the gradient, the slack is infinite.
struct NearlyLinear {
    Enclosure::Vector normal{};
    double at_centre, slack;
    bool is_bent = false;  ///< what it is by

    /// `half` are the box's half extents.
    NearlyLinear(const Enclosure& f, const Enclosure::Vector& half) : at_centre(f.centre), slack(0) {
        double aside = 0, squared_half = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Range& g = f.gradient[i];
            const double at = f.centre_gradient[i];
            if (!(g.low <= g.high && g.high - g.low < 1e30)) {
                slack = std::numeric_limits<double>::infinity();
                return;
            }
            normal[i] = g.middle();
            slack += 0.5 * (g.high - g.low) * half[i];
            aside += std::max(std::abs(g.high - at), std::abs(g.low - at)) * half[i];
            squared_half += half[i] * half[i];
        }
        const double above = std::min(aside, 0.5 * std::max(f.curvature.high, 0.0) * squared_half);
        const double below = std::min(aside, 0.5 * std::max(-f.curvature.low, 0.0) * squared_half);
        if (!(0.5 * (above + below) < slack)) return;
        is_bent = true;
        normal = f.centre_gradient;
        at_centre += 0.5 * (above - below);
        slack = 0.5 * (above + below);
    }
    /// How far the gradient is from the normal at most.
    double spread(const Enclosure& f, const Enclosure::Vector& half) const {
        double squared = 0, squared_half = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Range& g = f.gradient[i];
            const double off = std::max(std::abs(g.high - normal[i]), std::abs(g.low - normal[i]));
            squared += off * off;
            squared_half += half[i] * half[i];
        }
        const double most = std::sqrt(squared);
        return is_bent ? std::min(most, f.curvature.magnitude() * std::sqrt(squared_half)) : most;
    }
};

/// Cuts the value's range to what that allows.
inline void tighten_by_bend(Enclosure& f, const Enclosure::Vector& half) {
    const NearlyLinear linear(f, half);
    double reach = linear.slack;
    for (std::size_t i = 0; i < 3; ++i) reach += std::abs(linear.normal[i]) * half[i];
    if (!(reach < 1e30)) return;
    const double low = std::max(f.value.low, linear.at_centre - reach);
    const double high = std::min(f.value.high, linear.at_centre + reach);
    f.value = {std::min(low, high), std::max(low, high)};  // as tighten() does
}

}  // namespace phasetree::bounding
