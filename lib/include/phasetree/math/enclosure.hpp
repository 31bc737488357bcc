#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// All numbers from low to high.
struct Range {
    double low = 0, high = 0;

    /// Stands for every number; finite, so that no product of it with zero is NaN.
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
[[gnu::always_inline]] inline Range reciprocal(const Range& a) {
    if (a.low <= 0 && a.high >= 0) return Range::all();
    return limited(1 / a.high, 1 / a.low);
}

/// What a number may be in a box: its value at the box's centre, the range of its value, and those of its gradient's
/// components. A number type as the others (number.hpp): of a field's equation it makes certain statements about all
/// points of a box. Both branches count where a comparison is undecided.
///
/// For a continuous field that is differentiable but on seams, the gradient's ranges hold every one-sided gradient, so
/// that f(p) − f(centre) lies in their product with p − centre (tightened()). In double, without directed rounding: who
/// uses it allows for the rounding of floats, which is larger.
struct Enclosure {
    double centre = 0;
    Range value;
    std::array<Range, 3> gradient{};

    Enclosure() = default;
    explicit Enclosure(float v) : centre(static_cast<double>(v)), value{centre, centre} {}
    Enclosure(double c, const Range& v, const std::array<Range, 3>& g) : centre(c), value(v), gradient(g) {}

    /// A coordinate of a point of the box.
    static Enclosure coordinate(int axis, double middle, double half) {
        Enclosure e(middle, {middle - half, middle + half}, {});
        e.gradient[static_cast<std::size_t>(axis)] = {1, 1};
        return e;
    }
    /// With the value's range cut to what the gradient allows in a box of these half extents.
    Enclosure tightened(const std::array<double, 3>& half) const {
        double reach = 0;
        for (std::size_t i = 0; i < 3; ++i) reach += gradient[i].magnitude() * half[i];
        Enclosure e = *this;
        e.value.low = std::max(value.low, centre - reach);
        e.value.high = std::min(value.high, centre + reach);
        if (e.value.low > e.value.high) std::swap(e.value.low, e.value.high);  // one number, but for rounding
        return e;
    }
};

namespace detail {
template <class F>
std::array<Range, 3> each_axis(F&& f) {
    return {f(std::size_t{0}), f(std::size_t{1}), f(std::size_t{2})};
}
}  // namespace detail

[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& a) {
    return {-a.centre, -a.value, detail::each_axis([&](std::size_t i) { return -a.gradient[i]; })};
}
[[gnu::always_inline]] inline Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    return {a.centre + b.centre, a.value + b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] + b.gradient[i]; })};
}
[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& a, const Enclosure& b) {
    return {a.centre - b.centre, a.value - b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] - b.gradient[i]; })};
}
[[gnu::always_inline]] inline Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    // A square is known better than a product.
    if (&a == &b)
        return {a.centre * a.centre, square(a.value),
                detail::each_axis([&](std::size_t i) { return a.gradient[i] * a.value * 2; })};
    return {a.centre * b.centre, a.value * b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] * b.value + b.gradient[i] * a.value; })};
}
[[gnu::always_inline]] inline Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    const Range inverse = reciprocal(b.value), v = a.value * inverse;
    return {a.centre / b.centre, v,
            detail::each_axis([&](std::size_t i) { return (a.gradient[i] - v * b.gradient[i]) * inverse; })};
}
[[gnu::always_inline]] inline Enclosure operator+(const Enclosure& a, float b) {
    return {a.centre + static_cast<double>(b), a.value + Range{b, b}, a.gradient};
}
[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& a, float b) {
    return a + -b;
}
[[gnu::always_inline]] inline Enclosure operator*(const Enclosure& a, float b) {
    const double k = static_cast<double>(b);
    return {a.centre * k, a.value * k, detail::each_axis([&](std::size_t i) { return a.gradient[i] * k; })};
}
[[gnu::always_inline]] inline Enclosure operator+(float a, const Enclosure& b) {
    return b + a;
}
[[gnu::always_inline]] inline Enclosure operator-(float a, const Enclosure& b) {
    return -b + a;
}
[[gnu::always_inline]] inline Enclosure operator*(float a, const Enclosure& b) {
    return b * a;
}

/// A comparison over a box: what it is at the centre, and whether it can be true, or false.
struct Decision {
    bool centre, can_be_true, can_be_false;
};
[[gnu::always_inline]] inline Decision less(const Enclosure& a, const Enclosure& b) {
    return {a.centre < b.centre, a.value.low < b.value.high, !(a.value.high < b.value.low)};
}
[[gnu::always_inline]] inline Enclosure select(const Decision& d, const Enclosure& yes, const Enclosure& no) {
    if (!d.can_be_false) return yes;
    if (!d.can_be_true) return no;
    return {d.centre ? yes.centre : no.centre, hull(yes.value, no.value),
            detail::each_axis([&](std::size_t i) { return hull(yes.gradient[i], no.gradient[i]); })};
}
[[gnu::always_inline]] inline Enclosure min(const Enclosure& a, const Enclosure& b) {
    Enclosure r = select(less(a, b), a, b);
    r.value = {std::min(a.value.low, b.value.low), std::min(a.value.high, b.value.high)};
    return r;
}
[[gnu::always_inline]] inline Enclosure max(const Enclosure& a, const Enclosure& b) {
    Enclosure r = select(less(b, a), a, b);
    r.value = {std::max(a.value.low, b.value.low), std::max(a.value.high, b.value.high)};
    return r;
}
[[gnu::always_inline]] inline Enclosure abs(const Enclosure& a) {
    Enclosure r = max(a, -a);
    r.value.low = std::max(r.value.low, 0.0);
    return r;
}
inline Enclosure floor(const Enclosure& a) {
    return {std::floor(a.centre), {std::floor(a.value.low), std::floor(a.value.high)}, {}};
}
[[gnu::always_inline]] inline Enclosure sqrt(const Enclosure& a) {
    const Range v{std::sqrt(std::max(a.value.low, 0.0)), std::sqrt(std::max(a.value.high, 0.0))};
    const Range slope =
        v.low > 0 ? Range{0.5 / v.high, 0.5 / v.low} : limited(v.high > 0 ? 0.5 / v.high : 0, Range::most);
    return {std::sqrt(std::max(a.centre, 0.0)), v,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] * slope; })};
}

}  // namespace phasetree
