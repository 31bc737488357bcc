// Interval arithmetic on moments. Its few operations round to nearest, so each result is widened by a few units in the
// last place of the largest operand, and by the smallest normal number in case of an underflow. A result that overflows
// becomes infinite in both directions. (The operators in enclosure/interval.hpp do neither.)
#include "measuring/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "enclosure/interval.hpp"

namespace phasetree::measuring {

using enclosure::Interval;

namespace {

constexpr double unit = 0x1p-53, infinity = std::numeric_limits<double>::infinity();
constexpr Interval anything{-infinity, infinity};

bool is_bounded(const Interval& a) {
    return std::isfinite(a.low) && std::isfinite(a.high);
}
// An interval widened by the errors of a few operations on numbers of this magnitude.
Interval widened(const Interval& a, double magnitude) {
    const double error = 16 * unit * magnitude + 2 * std::numeric_limits<double>::min();
    const Interval result{a.low - error, a.high + error};
    return is_bounded(result) ? result : anything;
}
Interval sum(const Interval& a, const Interval& b) {
    return widened({a.low + b.low, a.high + b.high}, a.magnitude() + b.magnitude());
}
Interval difference(const Interval& a, const Interval& b) {
    return sum(a, -b);
}
Interval product(const Interval& a, const Interval& b) {
    if (!is_bounded(a) || !is_bounded(b)) return anything;
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return widened({low, high}, std::max(-low, high));
}
Interval squared(const Interval& a) {
    const Interval p = product(a, a);
    return {std::max(p.low, 0.0), p.high};
}
// For a positive divisor.
Interval quotient(const Interval& a, const Interval& b) {
    if (!is_bounded(a) || !is_bounded(b)) return anything;
    const Interval q{std::min(a.low / b.low, a.low / b.high), std::max(a.high / b.low, a.high / b.high)};
    return widened(q, q.magnitude());
}

Interval at(const MomentBounds& m, std::size_t k) {
    return {m.low[k], m.high[k]};
}

// The integral of the product of two coordinates, relative to the centre of mass. The centre's coordinates are
// multiplied first, because the product of two integrals may overflow.
Interval about_centre(const MomentBounds& m, std::size_t i, std::size_t j) {
    const Interval a = quotient(at(m, 1 + i), at(m, 0)), b = quotient(at(m, 1 + j), at(m, 0));
    const Interval shift = product(i == j ? squared(a) : product(a, b), at(m, 0));
    return difference(at(m, product_index(i, j)), shift);
}
double estimate_about_centre(const Moments& m, std::size_t i, std::size_t j) {
    return m[0] > 0 ? m[product_index(i, j)] - m[1 + i] / m[0] * m[1 + j] : 0;
}

}  // namespace

Measured measured(double low, double high, double estimate) {
    return {low, high, std::clamp(std::isfinite(estimate) ? estimate : 0, low, high)};
}

// Besides the additions, the error of each term is less than 2¹⁵ · 2⁻⁵³ times its magnitude: see part_below().
MomentBounds::MomentBounds(const PhaseSums& sums, std::size_t additions) : estimate(sums.estimate) {
    const double error = (static_cast<double>(additions) + 0x1p15) * unit * (1 + 1e-6);
    for (std::size_t k = 0; k < low.size(); ++k) {
        low[k] = sums.low[k] - error * sums.magnitude[k];
        high[k] = sums.high[k] + error * sums.magnitude[k];
        if (k == 0 || (k >= product_index(0, 0) && k <= product_index(2, 2))) low[k] = std::max(low[k], 0.0);
        high[k] = std::max(high[k], low[k]);
    }
    if (sums.high[0] == 0) low = high = estimate = {};  // no box that may contain it
}

void MomentBounds::add(const MomentBounds& o, double factor) {
    if (factor == 0) return;
    for (std::size_t k = 0; k < low.size(); ++k) {
        const Interval s = sum({low[k], high[k]}, product({o.low[k], o.high[k]}, {factor, factor}));
        low[k] = s.low;
        high[k] = s.high;
        estimate[k] += factor * o.estimate[k];
    }
    low[0] = std::max(low[0], 0.0);
}

Body body_of(const Measured& volume, const MomentBounds& mass, const std::array<double, 3>& origin) {
    Body body;
    body.volume = volume;
    body.mass = measured(mass.low[0], mass.high[0], mass.estimate[0]);
    if (!(mass.low[0] > 0)) return body;
    for (std::size_t i = 0; i < 3; ++i) {
        const Interval centre = sum(quotient(at(mass, 1 + i), at(mass, 0)), {origin[i], origin[i]});
        const double estimate = mass.estimate[0] > 0 ? mass.estimate[1 + i] / mass.estimate[0] + origin[i] : 0;
        body.centre[i] = measured(centre.low, centre.high, estimate);
        for (std::size_t j = i; j < 3; ++j) {
            const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
            Interval moment =
                i == j ? sum(about_centre(mass, a, a), about_centre(mass, b, b)) : -about_centre(mass, i, j);
            if (i == j) moment = {std::max(moment.low, 0.0), std::max(moment.high, 0.0)};
            const Moments& m = mass.estimate;
            const double guess = i == j ? estimate_about_centre(m, a, a) + estimate_about_centre(m, b, b)
                                        : -estimate_about_centre(m, i, j);
            body.inertia[i][j] = body.inertia[j][i] = measured(moment.low, moment.high, guess);
        }
    }
    return body;
}

}  // namespace phasetree::measuring
