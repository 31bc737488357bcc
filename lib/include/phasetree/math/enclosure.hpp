#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
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
/// [−a, a].
[[gnu::always_inline]] inline Range within(double a) {
    return limited(-a, a);
}
[[gnu::always_inline]] inline Range reciprocal(const Range& a) {
    if (a.low <= 0 && a.high >= 0) return Range::all();
    return limited(1 / a.high, 1 / a.low);
}

/// What a number may be in a box: its value and gradient at the box's centre (NaN on a seam), and the ranges of its
/// value, of its gradient's components, and of its second derivatives. A number type as the others (number.hpp): of a
/// field's equation it makes certain statements about all points of a box. Both branches count where a comparison is
/// undecided.
///
/// For a continuous field that is differentiable but on seams, the gradient's ranges hold every one-sided gradient, so
/// that f(p) − f(centre) lies in their product with p − centre (tightened()). `curvature` holds d²f/dt² along every
/// straight line of unit speed; a seam across which the slope jumps up or down counts as an endless one. So, for points
/// a distance h apart, f half way lies above the mean of f at both by −curvature.high·h²/8 to −curvature.low·h²/8; and
/// f is semiconcave with the constant curvature.high: minima of such fields are so too, whatever their seams.
///
/// In double, without directed rounding: who uses it allows for the rounding of floats, which is larger.
struct Enclosure {
    using Vector = std::array<double, 3>;

    double centre = 0;
    Range value;
    std::array<Range, 3> gradient{};
    Vector centre_gradient{};
    Range curvature;
    Range value_curvature;  ///< value · curvature, which is finite where a distance is zero

    Enclosure() = default;
    explicit Enclosure(float v) : centre(static_cast<double>(v)), value{centre, centre} {}
    Enclosure(double c, const Range& v, const std::array<Range, 3>& g, const Vector& cg, const Range& b)
        : centre(c), value(v), gradient(g), centre_gradient(cg), curvature(b), value_curvature(v * b) {}

    /// A coordinate of a point of the box.
    static Enclosure coordinate(int axis, double middle, double half) {
        Enclosure e;
        e.centre = middle;
        e.value = {middle - half, middle + half};
        e.gradient[static_cast<std::size_t>(axis)] = {1, 1};
        e.centre_gradient[static_cast<std::size_t>(axis)] = 1;
        return e;
    }
    /// With the value's range cut to what the gradient allows in a box of these half extents.
    Enclosure tightened(const Vector& half) const {
        double reach = 0;
        for (std::size_t i = 0; i < 3; ++i) reach += gradient[i].magnitude() * half[i];
        Enclosure e = *this;
        e.value.low = std::max(value.low, centre - reach);
        e.value.high = std::min(value.high, centre + reach);
        if (e.value.low > e.value.high) std::swap(e.value.low, e.value.high);  // one number, but for rounding
        return e;
    }
    void set_curvature(const Range& c) {
        curvature = c;
        value_curvature = value * c;
    }
    /// What the gradient's squared length is at most.
    double squared_slope() const {
        double sum = 0;
        for (const Range& g : gradient) sum += g.magnitude() * g.magnitude();
        return sum;
    }
};

namespace detail {
template <class F>
std::array<Range, 3> each_axis(F&& f) {
    return {f(std::size_t{0}), f(std::size_t{1}), f(std::size_t{2})};
}
template <class F>
Enclosure::Vector each_number(F&& f) {
    return {f(std::size_t{0}), f(std::size_t{1}), f(std::size_t{2})};
}
/// Of the products of two numbers' slopes.
inline Range products_of_slopes(const Enclosure& a, const Enclosure& b) {
    return within(std::sqrt(a.squared_slope() * b.squared_slope()));
}
inline Range squares_of_slope(const Enclosure& a) {
    return limited(0, a.squared_slope());
}

/// On a seam of several there need be none that all agree on.
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
    // A square is known better than a product.
    if (&a == &b)
        return {a.centre * a.centre, square(a.value),
                detail::each_axis([&](std::size_t i) { return a.gradient[i] * a.value * 2; }), at_centre,
                (a.value_curvature + detail::squares_of_slope(a)) * 2};
    return {a.centre * b.centre, a.value * b.value,
            detail::each_axis([&](std::size_t i) { return a.gradient[i] * b.value + b.gradient[i] * a.value; }),
            at_centre, a.curvature * b.value + b.curvature * a.value + detail::products_of_slopes(a, b) * 2};
}
[[gnu::always_inline]] inline Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    const Range inverse = reciprocal(b.value), v = a.value * inverse;
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
    return {a.centre + static_cast<double>(b), a.value + Range{b, b}, a.gradient, a.centre_gradient, a.curvature};
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

/// A comparison over a box: what it is at the centre, whether the two are equal there, and whether it can be true, or
/// false.
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
            Range::all()};
}
[[gnu::always_inline]] inline Enclosure min(const Enclosure& a, const Enclosure& b) {
    const Decision d = less(a, b);
    Enclosure r = select(d, a, b);
    r.value = {std::min(a.value.low, b.value.low), std::min(a.value.high, b.value.high)};
    // On the seam the slope falls.
    if (d.can_be_true && d.can_be_false) r.set_curvature({-Range::most, std::max(a.curvature.high, b.curvature.high)});
    return r;
}
[[gnu::always_inline]] inline Enclosure max(const Enclosure& a, const Enclosure& b) {
    const Decision d = less(b, a);
    Enclosure r = select(d, a, b);
    r.value = {std::max(a.value.low, b.value.low), std::max(a.value.high, b.value.high)};
    if (d.can_be_true && d.can_be_false) {
        r.set_curvature({std::min(a.curvature.low, b.curvature.low), Range::most});
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
    const Range v{std::floor(a.value.low), std::floor(a.value.high)};
    return {std::floor(a.centre), v, {}, {}, v.low == v.high ? Range{} : Range::all()};
}
[[gnu::always_inline]] inline Enclosure sqrt(const Enclosure& a) {
    const Range v{std::sqrt(std::max(a.value.low, 0.0)), std::sqrt(std::max(a.value.high, 0.0))};
    const Range slope =
        v.low > 0 ? Range{0.5 / v.high, 0.5 / v.low} : limited(v.high > 0 ? 0.5 / v.high : 0, Range::most);
    const double centre = std::sqrt(std::max(a.centre, 0.0)), centre_slope = centre > 0 ? 0.5 / centre : 0;
    Enclosure r(centre, v, detail::each_axis([&](std::size_t i) { return a.gradient[i] * slope; }),
                detail::each_number([&](std::size_t i) { return a.centre_gradient[i] * centre_slope; }), Range::all());
    // (√a)″ = a″/2√a − (√a)′²/√a
    if (v.low > 0) r.set_curvature(a.curvature * slope - detail::squares_of_slope(r) * slope * 2);
    return r;
}

namespace detail {
/// What the square of a vector's derivative by any direction is at most: of its Jacobian J the largest eigenvalue of
/// JᵀJ, which is within the sums of rows.
template <std::size_t n>
double squared_stretch(const std::array<const Enclosure*, n>& x) {
    std::array<std::array<Range, 3>, 3> squared{};
    for (const Enclosure* e : x)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = i; j < 3; ++j)
                squared[i][j] = squared[i][j] + (i == j ? square(e->gradient[i]) : e->gradient[i] * e->gradient[j]);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) row += squared[std::min(i, j)][std::max(i, j)].magnitude();
        most = std::max(most, row);
    }
    return most;
}
/// How long the vector's second derivative is at most.
template <std::size_t n>
double curvature_of(const std::array<const Enclosure*, n>& x) {
    double sum = 0;
    for (const Enclosure* e : x) sum += e->curvature.magnitude() * e->curvature.magnitude();
    return std::min(std::sqrt(sum), Range::most);
}
/// Of a convex function that grows with each of these and is 1-Lipschitz in them.
inline Enclosure with_least_curvature(Enclosure f, std::initializer_list<const Enclosure*> x) {
    double sum = 0;
    for (const Enclosure* e : x) sum += std::min(e->curvature.low, 0.0) * std::min(e->curvature.low, 0.0);
    f.curvature.low = std::max(f.curvature.low, std::max(-std::sqrt(sum), -Range::most));
    f.value_curvature = f.value * f.curvature;
    return f;
}
/// Of the length of a vector whose length was found: for f = |x|, f″ = (|x′|² − f′² + x·x″)/f with 0 ≤ f′² ≤ |x′|².
template <std::size_t n>
Enclosure with_curvature_of_length(Enclosure f, const std::array<const Enclosure*, n>& x) {
    Range along{};
    for (const Enclosure* e : x) along = along + e->value_curvature;
    const double stretch = squared_stretch(x), steepest = std::min(std::sqrt(stretch), Range::most);
    for (Range& g : f.gradient) g = {std::max(g.low, -steepest), std::min(g.high, steepest)};
    const Range product = limited(0, stretch) + along;
    if (!(f.value.low > 0)) {
        f.value_curvature = product;
        return f;
    }
    const Range curvature = product * reciprocal(f.value);
    f.set_curvature({std::max(f.curvature.low, curvature.low), std::min(f.curvature.high, curvature.high)});
    return f;
}
/// Whether their gradients are constant, as a point's coordinates' mostly are.
template <std::size_t n>
bool are_affine(const std::array<const Enclosure*, n>& x) {
    for (const Enclosure* e : x) {
        if (e->curvature.low != 0 || e->curvature.high != 0) return false;
        for (const Range& g : e->gradient)
            if (g.low != g.high) return false;
    }
    return true;
}
/// The length of a vector of such, without the detour over its square.
template <std::size_t n>
Enclosure length_of_affine(const std::array<const Enclosure*, n>& x) {
    Range squared{};
    double at_centre = 0;
    for (const Enclosure* e : x) {
        const Range s = square(e->value);
        squared.low += s.low;
        squared.high += s.high;
        at_centre += e->centre * e->centre;
    }
    Enclosure f;
    f.centre = std::sqrt(at_centre);
    f.value = limited(std::sqrt(squared.low), std::sqrt(squared.high));
    std::array<std::array<double, 3>, 3> product{};  // of the Jacobian with itself
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) {
            for (const Enclosure* e : x) product[i][j] += e->gradient[i].low * e->gradient[j].low;
            product[j][i] = product[i][j];
        }
    double stretch = 0;
    for (const auto& row : product) stretch = std::max(stretch, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
    const Range inverse = f.value.low > 0 ? limited(1 / f.value.high, 1 / f.value.low)
                                          : limited(f.value.high > 0 ? 1 / f.value.high : 0, Range::most);
    for (std::size_t i = 0; i < 3; ++i) {
        Range sum{};
        double sum_at_centre = 0;
        for (const Enclosure* e : x) {
            const double g = e->gradient[i].low;
            if (g == 0) continue;
            sum = sum + e->value * g;
            sum_at_centre += e->centre * g;
        }
        const double steepest = std::sqrt(product[i][i]);
        const Range slope = sum * inverse;
        f.gradient[i] = {std::max(slope.low, -steepest), std::min(slope.high, steepest)};
        f.centre_gradient[i] = f.centre > 0 ? sum_at_centre / f.centre : 0;
    }
    const Range bends = limited(0, stretch);
    f.curvature = f.value.low > 0 ? bends * inverse : limited(0, Range::most);
    f.value_curvature = bends;
    return f;
}
}  // namespace detail

inline Enclosure length(const Vec3<Enclosure>& a) {
    const std::array<const Enclosure*, 3> x{&a.x, &a.y, &a.z};
    if (detail::are_affine(x)) return detail::length_of_affine(x);
    return detail::with_curvature_of_length(sqrt(dot(a, a)), x);
}
inline Enclosure length(const Enclosure& x, const Enclosure& y) {
    const std::array<const Enclosure*, 2> both{&x, &y};
    if (detail::are_affine(both)) return detail::length_of_affine(both);
    return detail::with_curvature_of_length(sqrt(x * x + y * y), both);
}

/// As the template, whose seams are none: with h(δ) = |δ|/2 + r/6·max(1 − |δ|/r, 0)³ for δ = b − a it is (a + b)/2 −
/// h(δ), and 0 ≤ h″ ≤ max(1 − |δ|/r, 0)/r.
inline Enclosure smooth_min(const Enclosure& a, const Enclosure& b, float r) {
    const Enclosure apart = b - a;
    Enclosure s = smooth_min<Enclosure>(a, b, r);
    const double radius = static_cast<double>(r);
    const Range& v = apart.value;
    const double nearest = v.low > 0 ? v.low : v.high < 0 ? -v.high : 0;
    if (nearest >= radius) return s;
    const double sharpest = (1 - nearest / radius) / radius;
    s.set_curvature(limited(std::min(a.curvature.low, b.curvature.low) - sharpest * apart.squared_slope(),
                            std::max(a.curvature.high, b.curvature.high)));
    return s;
}

/// As the template: φ(x) = (1 − x²)³ for x = d/R in [0, 1] has φ″ = (1 − u)(30u − 6) with u = x², from −6 to 4.8.
inline Enclosure falloff(const Enclosure& d, float reach) {
    Enclosure f = falloff<Enclosure>(d, reach);
    const double k = 1 / static_cast<double>(reach);
    const auto inside = [&](double x) { return std::clamp(x * k, 0.0, 1.0); };
    const double from = inside(d.value.low), to = inside(d.value.high);
    const auto curvature = [](double x) { return (1 - x * x) * (30 * x * x - 6); };
    const auto slope = [](double x) { return -6 * x * (1 - x * x) * (1 - x * x); };
    Range bends = hull({curvature(from), curvature(from)}, {curvature(to), curvature(to)});
    Range slopes = hull({slope(from), slope(from)}, {slope(to), slope(to)});
    constexpr double most_curved = 0.7745966692414834, steepest = 0.4472135954999579;  // √0.6, √0.2
    if (from < most_curved && to > most_curved) bends.high = 4.8;
    if (from < steepest && to > steepest) slopes.low = -static_cast<double>(steepest_falloff) * (1 + 1e-6);
    if (d.value.low < 0 || d.value.high * k > 1) bends = hull(bends, {});  // flat beyond
    const Range by_slope = detail::squares_of_slope(d) * (bends * (k * k));
    const Range straight = d.curvature * (slopes * k);
    // At a skeleton φ′ vanishes as d does: φ′(d)/d = −6(1 − x²)²/R².
    const auto share = [](double x) { return -6 * (1 - x * x) * (1 - x * x); };
    Range shares = hull({share(from), share(from)}, {share(to), share(to)});
    if (d.value.low < 0) shares = hull(shares, {});
    const Range near = d.value_curvature * (shares * (k * k));
    f.set_curvature(by_slope + Range{std::max(straight.low, near.low), std::min(straight.high, near.high)});
    return f;
}

/// Where one of them is never positive, it is the larger of it and the others' corner, by the template's equation. And
/// it is convex: outside the largest sum of the two, weighted by a vector of unit length without negative components.
inline Enclosure corner(const Enclosure& a, const Enclosure& b) {
    if (a.value.high <= 0 || b.value.high <= 0) return max(a, b);
    return detail::with_least_curvature(corner<Enclosure>(a, b), {&a, &b});
}
inline Enclosure corner(const Enclosure& a, const Enclosure& b, const Enclosure& c) {
    if (a.value.high <= 0) return max(a, corner(b, c));
    if (b.value.high <= 0) return max(b, corner(a, c));
    if (c.value.high <= 0) return max(c, corner(a, b));
    return detail::with_least_curvature(corner<Enclosure>(a, b, c), {&a, &b, &c});
}

/// Slopes agree on the seam, so it bends nothing.
inline Enclosure select_smoothly(const Decision& d, const Enclosure& yes, const Enclosure& no) {
    Enclosure r = select(d, yes, no);
    r.set_curvature(!d.can_be_false  ? yes.curvature
                    : !d.can_be_true ? no.curvature
                                     : hull(yes.curvature, no.curvature));
    return r;
}

template <class Other>
Enclosure also_known_as(const Enclosure& f, const Other& other) {
    const auto [is_certain, g] = other([](const Decision& d) { return !d.can_be_false; });
    return is_certain ? g : f;
}

/// A squared distance to a convex set is convex, and no more curved than that to a point.
inline Enclosure squared_distance_to_segment(const Vec3<Enclosure>& q, const glm::vec3& along, float inverse) {
    Enclosure r = squared_distance_to_segment<Enclosure>(q, along, inverse);
    const std::array<const Enclosure*, 3> x{&q.x, &q.y, &q.z};
    const double aside = 2 * std::sqrt(r.value.high) * detail::curvature_of(x);
    const Range curvature = limited(-aside, 2 * detail::squared_stretch(x) + aside);
    r.set_curvature({std::max(r.curvature.low, curvature.low), std::min(r.curvature.high, curvature.high)});
    return r;
}

/// A 1-Lipschitz function that is convex in q falls off a straight line only as q does.
inline Enclosure known_to_be_convex(Enclosure f, const Vec3<Enclosure>& q) {
    const double aside = detail::curvature_of<3>({&q.x, &q.y, &q.z});
    f.curvature.low = std::max(f.curvature.low, -aside);
    f.value_curvature = f.value * f.curvature;
    return f;
}

/// As the template, whose seams are none where it stands for sine and cosine.
inline SineCosine<Enclosure> sine_cosine(const Enclosure& x) {
    SineCosine<Enclosure> r = sine_cosine<Enclosure>(x);
    if (!(x.value.magnitude() < 1e4)) return r;
    const auto cut = [](const Range& v) { return Range{std::max(v.low, -1.0), std::min(v.high, 1.0)}; };
    const Range s = cut(r.sine.value), c = cut(r.cosine.value);
    r.sine.set_curvature(c * x.curvature - s * detail::squares_of_slope(x));
    r.cosine.set_curvature(-s * x.curvature - c * detail::squares_of_slope(x));
    return r;
}

}  // namespace phasetree
