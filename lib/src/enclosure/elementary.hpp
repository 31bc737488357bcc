#pragma once

#include <cmath>
#include <numbers>

#include "enclosure/length.hpp"
#include "enclosure/number.hpp"
#include "phasetree/math/elementary.hpp"

namespace phasetree::enclosure {

namespace detail {
/// The enclosure of g(x) from the ranges of g, g′ and g″ over the range of x, and g and g′ at the centre: (g∘x)″ = g′
/// x″ + g″ x′².
inline Enclosure composed(const Enclosure& x, double g, double slope, const Interval& values, const Interval& slopes,
                          const Interval& bends) {
    Enclosure r(g, values, each_axis([&](std::size_t i) { return x.gradient[i] * slopes; }),
                each_number([&](std::size_t i) { return x.centre_gradient[i] * slope; }), {});
    r.set_curvature(x.curvature * slopes + squares_of_slope(x) * bends);
    return r;
}
/// The range of the sine: −1 or 1 if x contains the position of an extremum, otherwise the values at the ends.
inline Interval range_of_sine(const Interval& x) {
    const double turn = 2 * std::numbers::pi, quarter = std::numbers::pi / 2;
    if (x.high - x.low >= turn) return {-1, 1};
    const double low = std::sin(x.low), high = std::sin(x.high);
    const auto has = [&](double at) { return std::floor((x.high - at) / turn) > std::floor((x.low - at) / turn); };
    return {has(-quarter) ? -1 : std::min(low, high), has(quarter) ? 1 : std::max(low, high)};
}
/// The domain in which sine_of() and cosine_of() are valid.
inline bool is_in_domain_of_sine(const Enclosure& x) {
    return x.value.magnitude() <= 1e4;
}
inline Enclosure unknown(double centre) {
    Enclosure r(centre, Interval::all(), {Interval::all(), Interval::all(), Interval::all()}, no_gradient,
                Interval::all());
    return r;
}
}  // namespace detail

inline Enclosure sine_of(const Enclosure& x) {
    const double s = std::sin(x.centre), c = std::cos(x.centre);
    if (!detail::is_in_domain_of_sine(x)) return detail::unknown(s);
    const double quarter = std::numbers::pi / 2;
    const Interval sines = detail::range_of_sine(x.value);
    return detail::composed(x, s, c, sines, detail::range_of_sine(x.value + Interval{quarter, quarter}), -sines);
}
inline Enclosure cosine_of(const Enclosure& x) {
    const double s = std::sin(x.centre), c = std::cos(x.centre);
    if (!detail::is_in_domain_of_sine(x)) return detail::unknown(c);
    const double quarter = std::numbers::pi / 2;
    const Interval cosines = detail::range_of_sine(x.value + Interval{quarter, quarter});
    return detail::composed(x, c, -s, cosines, -detail::range_of_sine(x.value), -cosines);
}

/// √(a² + b²) of a formula.
inline Enclosure length_of(const Enclosure& a, const Enclosure& b) {
    return length(a, b);
}

/// Constant outside ±80, with seams there.
inline Enclosure exponential(const Enclosure& x) {
    const Enclosure a = min(max(x, Enclosure(-80.f)), Enclosure(80.f));
    const double e = std::exp(a.centre);
    const Interval values{std::exp(a.value.low), std::exp(a.value.high)};
    return detail::composed(a, e, e, values, values, values);
}

}  // namespace phasetree::enclosure
