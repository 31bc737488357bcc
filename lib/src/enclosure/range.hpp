#pragma once

#include <algorithm>

namespace phasetree::enclosure {

/// The interval of all numbers from low to high.
struct Range {
    double low = 0, high = 0;

    /// Represents infinity. It is finite, so that its product with zero is not NaN.
    static constexpr double most = 1e100;
    static constexpr Range all() { return {-most, most}; }

    double magnitude() const { return std::max(-low, high); }
    double middle() const { return 0.5 * (low + high); }
};

[[gnu::always_inline]] inline Range limited(double low, double high) {
    return {low > -Range::most ? low : -Range::most, high < Range::most ? high : Range::most};
}
[[gnu::always_inline]] inline Range hull(const Range& a, const Range& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}
[[gnu::always_inline]] inline Range operator-(const Range& a) {
    return {-a.high, -a.low};
}
[[gnu::always_inline]] inline Range operator+(const Range& a, const Range& b) {
    return limited(a.low + b.low, a.high + b.high);
}
[[gnu::always_inline]] inline Range operator-(const Range& a, const Range& b) {
    return limited(a.low - b.high, a.high - b.low);
}
[[gnu::always_inline]] inline Range operator*(const Range& a, double b) {
    return b < 0 ? limited(a.high * b, a.low * b) : limited(a.low * b, a.high * b);
}
[[gnu::always_inline]] inline Range operator*(const Range& a, const Range& b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return limited(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}
[[gnu::always_inline]] inline Range square(const Range& a) {
    const double p = a.low * a.low, q = a.high * a.high;
    return limited(a.low <= 0 && a.high >= 0 ? 0 : std::min(p, q), std::max(p, q));
}
/// The interval [−a, a].
[[gnu::always_inline]] inline Range within(double a) {
    return limited(-a, a);
}
[[gnu::always_inline]] inline Range reciprocal(const Range& a) {
    if (a.low <= 0 && a.high >= 0) return Range::all();
    return limited(1 / a.high, 1 / a.low);
}

}  // namespace phasetree::enclosure
