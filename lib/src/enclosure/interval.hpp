#pragma once

#include <algorithm>

namespace phasetree::enclosure {

/// The interval of all numbers from low to high.
struct Interval {
    double low = 0, high = 0;

    /// Represents infinity. It is finite, so that its product with zero is not NaN.
    static constexpr double most = 1e100;
    static constexpr Interval all() { return {-most, most}; }

    double magnitude() const { return std::max(-low, high); }
    double middle() const { return 0.5 * (low + high); }
};

[[gnu::always_inline]] inline Interval limited(double low, double high) {
    return {low > -Interval::most ? low : -Interval::most, high < Interval::most ? high : Interval::most};
}
[[gnu::always_inline]] inline Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
[[gnu::always_inline]] inline Interval operator-(const Interval& a) {
    return {-a.high, -a.low};
}
[[gnu::always_inline]] inline Interval operator+(const Interval& a, const Interval& b) {
    return limited(a.low + b.low, a.high + b.high);
}
[[gnu::always_inline]] inline Interval operator-(const Interval& a, const Interval& b) {
    return limited(a.low - b.high, a.high - b.low);
}
[[gnu::always_inline]] inline Interval operator*(const Interval& a, double b) {
    return b < 0 ? limited(a.high * b, a.low * b) : limited(a.low * b, a.high * b);
}
[[gnu::always_inline]] inline Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return limited(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}
[[gnu::always_inline]] inline Interval square(const Interval& a) {
    const double p = a.low * a.low, q = a.high * a.high;
    return limited(a.low <= 0 && a.high >= 0 ? 0 : std::min(p, q), std::max(p, q));
}
/// The interval [−a, a].
[[gnu::always_inline]] inline Interval within(double a) {
    return limited(-a, a);
}
[[gnu::always_inline]] inline Interval reciprocal(const Interval& a) {
    if (a.low <= 0 && a.high >= 0) return Interval::all();
    return limited(1 / a.high, 1 / a.low);
}

}  // namespace phasetree::enclosure
