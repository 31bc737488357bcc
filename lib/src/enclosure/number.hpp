#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "enclosure/interval.hpp"

namespace phasetree::enclosure {

/// The enclosure of a number that varies in a box. It consists of the value and gradient at the box's centre, and of
/// the ranges of the value, the gradient's components and the second derivatives. The gradient at the centre is NaN on
/// a seam. It is a number type like those of phasetree/math/number.hpp: evaluating a field's equation with it gives
/// bounds for all points of a box. Where a comparison is undecided, the result covers both branches.
///
/// A *seam* is a surface on which the equation switches from one branch to another, such as the points where the
/// operands of a minimum are equal.
///
/// For a continuous field that is differentiable except on seams, the gradient's ranges contain every one-sided
/// gradient. So f(p) − f(centre) lies in their product with p − centre (tightened()). `curvature` contains d²f/dt²
/// along every straight line of unit speed; a seam across which the slope jumps up or down counts as infinite. So
/// consider two points a distance h apart: f midway lies above the mean of f at both by −curvature.high·h²/8 to
/// −curvature.low·h²/8. Hence f is semiconcave with the constant curvature.high, and so are minima of such fields,
/// whatever their seams.
///
/// It is computed in double, without directed rounding. Users must allow for the rounding errors of floats, which are
/// larger. They must allow for twice the error bound of a single value, because primitives at the centre may also be
/// computed in floats.
struct Enclosure {
    using Vector = std::array<double, 3>;

    double centre = 0;
    Interval value;
    std::array<Interval, 3> gradient{};
    Vector centre_gradient{};
    Interval curvature;
    Interval value_curvature;  ///< value · curvature, which is finite where a distance is zero

    Enclosure() = default;
    explicit Enclosure(float v) : centre(static_cast<double>(v)), value{centre, centre} {}
    [[gnu::always_inline]] Enclosure(double c, const Interval& v, const std::array<Interval, 3>& g, const Vector& cg,
                                     const Interval& b)
        : centre(c), value(v), gradient(g), centre_gradient(cg), curvature(b), value_curvature(v * b) {}

    /// The coordinate of a point of the box along an axis; `middle` and `half` describe the box.
    [[gnu::always_inline]] static Enclosure coordinate(int axis, double middle, double half) {
        Enclosure e;
        e.centre = middle;
        e.value = {middle - half, middle + half};
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            e.centre_gradient[k] = i == axis ? 1 : 0;
            e.gradient[k] = {e.centre_gradient[k], e.centre_gradient[k]};
        }
        return e;
    }
    /// Narrows the value's range to what the value at the centre and the gradient allow in a box with these half
    /// extents.
    void tighten(const Vector& half) {
        const double half_width =
            gradient[0].magnitude() * half[0] + gradient[1].magnitude() * half[1] + gradient[2].magnitude() * half[2];
        const double low = std::max(value.low, centre - half_width), high = std::min(value.high, centre + half_width);
        value = {std::min(low, high), std::max(low, high)};  // if they cross, they are equal up to rounding errors
    }
    Enclosure tightened(const Vector& half) const {
        Enclosure e = *this;
        e.tighten(half);
        return e;
    }
    [[gnu::always_inline]] void set_curvature(const Interval& c) {
        curvature = c;
        value_curvature = value * c;
    }
    /// An upper bound on the gradient's squared length.
    double squared_slope() const {
        double sum = 0;
        for (const Interval& g : gradient) sum += g.magnitude() * g.magnitude();
        return sum;
    }
};

namespace detail {
template <class F>
[[gnu::always_inline]] inline std::array<Interval, 3> each_axis(F&& f) {
    return {f(std::size_t{0}), f(std::size_t{1}), f(std::size_t{2})};
}
template <class F>
[[gnu::always_inline]] inline Enclosure::Vector each_number(F&& f) {
    return {f(std::size_t{0}), f(std::size_t{1}), f(std::size_t{2})};
}
/// The range of the product of the slopes of a and b along any line, and that of the square of the slope of a.
inline Interval products_of_slopes(const Enclosure& a, const Enclosure& b) {
    return within(std::sqrt(a.squared_slope() * b.squared_slope()));
}
inline Interval squares_of_slope(const Enclosure& a) {
    return limited(0, a.squared_slope());
}

/// The gradient at the centre if that lies on a seam, where the branches need not agree.
inline constexpr Enclosure::Vector no_gradient{std::numeric_limits<double>::quiet_NaN(),
                                               std::numeric_limits<double>::quiet_NaN(),
                                               std::numeric_limits<double>::quiet_NaN()};
}  // namespace detail

[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& a) {
    Enclosure r(-a.centre, -a.value, detail::each_axis([&](std::size_t i) { return -a.gradient[i]; }),
                detail::each_number([&](std::size_t i) { return -a.centre_gradient[i]; }), -a.curvature);
    r.value_curvature = a.value_curvature;
    return r;
}
[[gnu::always_inline]] inline Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    return {a.centre + b.centre, a.value + b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] + b.gradient[i]; }),
            detail::each_number([&](std::size_t i) { return a.centre_gradient[i] + b.centre_gradient[i]; }),
            a.curvature + b.curvature};
}
[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& a, const Enclosure& b) {
    return {a.centre - b.centre, a.value - b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] - b.gradient[i]; }),
            detail::each_number([&](std::size_t i) { return a.centre_gradient[i] - b.centre_gradient[i]; }),
            a.curvature - b.curvature};
}
[[gnu::always_inline]] inline Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    const auto at_centre = detail::each_number(
        [&](std::size_t i) { return a.centre_gradient[i] * b.centre + b.centre_gradient[i] * a.centre; });
    // A square has a smaller range than a product of two numbers.
    if (&a == &b)
        return {a.centre * a.centre, square(a.value),
                detail::each_axis([&](std::size_t i) { return a.gradient[i] * a.value * 2; }), at_centre,
                (a.value_curvature + detail::squares_of_slope(a)) * 2};
    return {a.centre * b.centre, a.value * b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] * b.value + b.gradient[i] * a.value; }),
            at_centre, a.curvature * b.value + b.curvature * a.value + detail::products_of_slopes(a, b) * 2};
}
[[gnu::always_inline]] inline Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    const Interval inverse = reciprocal(b.value), v = a.value * inverse;
    const double quotient = a.centre / b.centre;
    Enclosure r(quotient, v,
                detail::each_axis([&](std::size_t i) { return (a.gradient[i] - v * b.gradient[i]) * inverse; }),
                detail::each_number(
                    [&](std::size_t i) { return (a.centre_gradient[i] - quotient * b.centre_gradient[i]) / b.centre; }),
                {});
    r.set_curvature((a.curvature - v * b.curvature - detail::products_of_slopes(r, b) * 2) * inverse);
    return r;
}
[[gnu::always_inline]] inline Enclosure operator+(const Enclosure& a, float b) {
    return {a.centre + static_cast<double>(b), a.value + Interval{b, b}, a.gradient, a.centre_gradient, a.curvature};
}
[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& a, float b) {
    return a + -b;
}
[[gnu::always_inline]] inline Enclosure operator*(const Enclosure& a, float b) {
    const double k = static_cast<double>(b);
    Enclosure r(a.centre * k, a.value * k, detail::each_axis([&](std::size_t i) { return a.gradient[i] * k; }),
                detail::each_number([&](std::size_t i) { return a.centre_gradient[i] * k; }), a.curvature * k);
    r.value_curvature = a.value_curvature * (k * k);
    return r;
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

/// A comparison over a box: whether it is true at the centre, whether both sides are equal there, and whether it can be
/// true or false anywhere in the box.
struct Decision {
    bool centre, is_tie, can_be_true, can_be_false;
};
[[gnu::always_inline]] inline Decision less(const Enclosure& a, const Enclosure& b) {
    return {a.centre < b.centre, a.centre == b.centre, a.value.low < b.value.high, !(a.value.high < b.value.low)};
}
[[gnu::always_inline]] inline Enclosure select(const Decision& d, const Enclosure& yes, const Enclosure& no) {
    if (!d.can_be_false) return yes;
    if (!d.can_be_true) return no;
    return {d.centre ? yes.centre : no.centre, hull(yes.value, no.value),
            detail::each_axis([&](std::size_t i) { return hull(yes.gradient[i], no.gradient[i]); }),
            d.is_tie   ? detail::no_gradient
            : d.centre ? yes.centre_gradient
                       : no.centre_gradient,
            Interval::all()};
}
[[gnu::always_inline]] inline Enclosure min(const Enclosure& a, const Enclosure& b) {
    const Decision d = less(a, b);
    Enclosure r = select(d, a, b);
    r.value = {std::min(a.value.low, b.value.low), std::min(a.value.high, b.value.high)};
    // On the seam of a minimum, the slope falls, so the curvature is still bounded from above.
    if (d.can_be_true && d.can_be_false)
        r.set_curvature({-Interval::most, std::max(a.curvature.high, b.curvature.high)});
    return r;
}
[[gnu::always_inline]] inline Enclosure max(const Enclosure& a, const Enclosure& b) {
    const Decision d = less(b, a);
    Enclosure r = select(d, a, b);
    r.value = {std::max(a.value.low, b.value.low), std::max(a.value.high, b.value.high)};
    if (d.can_be_true && d.can_be_false) {
        r.set_curvature({std::min(a.curvature.low, b.curvature.low), Interval::most});
        const bool is_zero = b.value.low == 0 && b.value.high == 0 && b.squared_slope() == 0;
        if (is_zero) r.value_curvature = r.value * hull(a.curvature, {});
    }
    return r;
}
[[gnu::always_inline]] inline Enclosure abs(const Enclosure& a) {
    Enclosure r = max(a, -a);
    r.value.low = std::max(r.value.low, 0.0);
    if (a.value.low < 0 && a.value.high > 0) r.value_curvature = a.value_curvature;
    return r;
}
inline Enclosure floor(const Enclosure& a) {
    const Interval v{std::floor(a.value.low), std::floor(a.value.high)};
    return {std::floor(a.centre), v, {}, {}, v.low == v.high ? Interval{} : Interval::all()};
}
[[gnu::always_inline]] inline Enclosure sqrt(const Enclosure& a) {
    const Interval v{std::sqrt(std::max(a.value.low, 0.0)), std::sqrt(std::max(a.value.high, 0.0))};
    const Interval slope =
        v.low > 0 ? Interval{0.5 / v.high, 0.5 / v.low} : limited(v.high > 0 ? 0.5 / v.high : 0, Interval::most);
    const double centre = std::sqrt(std::max(a.centre, 0.0)), centre_slope = centre > 0 ? 0.5 / centre : 0;
    Enclosure r(centre, v, detail::each_axis([&](std::size_t i) { return a.gradient[i] * slope; }),
                detail::each_number([&](std::size_t i) { return a.centre_gradient[i] * centre_slope; }),
                Interval::all());
    // (√a)″ = a″/2√a − (√a)′²/√a
    if (v.low > 0) r.set_curvature(a.curvature * slope - detail::squares_of_slope(r) * slope * 2);
    return r;
}

}  // namespace phasetree::enclosure
