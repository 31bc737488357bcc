#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "enclosure/length.hpp"

namespace phasetree::enclosure {

/// The template's minimum and maximum look like seams, but the sum has none. For δ = b − a, it is (a + b)/2 − h(δ) with
/// h(δ) = |δ|/2 + r/6·max(1 − |δ|/r, 0)³, and 0 ≤ h″ ≤ max(1 − |δ|/r, 0)/r.
inline Enclosure smooth_min(const Enclosure& a, const Enclosure& b, float r) {
    const Enclosure apart = b - a;
    Enclosure s = phasetree::smooth_min<Enclosure>(a, b, r);
    const double radius = static_cast<double>(r);
    const Interval& v = apart.value;
    const double nearest = v.low > 0 ? v.low : v.high < 0 ? -v.high : 0;
    if (nearest >= radius) return s;
    const double sharpest = (1 - nearest / radius) / radius;
    s.set_curvature(limited(std::min(a.curvature.low, b.curvature.low) - sharpest * apart.squared_slope(),
                            std::max(a.curvature.high, b.curvature.high)));
    return s;
}

/// The curvature follows from the derivatives of the falloff: φ(x) = (1 − x²)³ for x = d/R in [0, 1] has φ″ = (1 −
/// u)(30u − 6) with u = x², which ranges from −6 to 4.8.
inline Enclosure falloff(const Enclosure& d, float radius) {
    Enclosure f = phasetree::falloff<Enclosure>(d, radius);
    const double k = 1 / static_cast<double>(radius);
    const auto inside = [&](double x) { return std::clamp(x * k, 0.0, 1.0); };
    const double low = inside(d.value.low), high = inside(d.value.high);
    const auto curvature = [](double x) { return (1 - x * x) * (30 * x * x - 6); };
    const auto slope = [](double x) { return -6 * x * (1 - x * x) * (1 - x * x); };
    Interval bends = hull({curvature(low), curvature(low)}, {curvature(high), curvature(high)});
    Interval slopes = hull({slope(low), slope(low)}, {slope(high), slope(high)});
    constexpr double most_curved = 0.7745966692414834, steepest = 0.4472135954999579;  // √0.6, √0.2
    if (low < most_curved && high > most_curved) bends.high = 4.8;
    if (low < steepest && high > steepest) slopes.low = -static_cast<double>(steepest_falloff) * (1 + 1e-6);
    if (d.value.low < 0 || d.value.high * k > 1) bends = hull(bends, {});  // flat beyond
    const Interval by_slope = detail::squares_of_slope(d) * (bends * (k * k));
    const Interval straight = d.curvature * (slopes * k);
    // On a skeleton, φ′ vanishes at the same rate as d: φ′(d)/d = −6(1 − x²)²/R².
    const auto share = [](double x) { return -6 * (1 - x * x) * (1 - x * x); };
    Interval shares = hull({share(low), share(low)}, {share(high), share(high)});
    if (d.value.low < 0) shares = hull(shares, {});
    const Interval near = d.value_curvature * (shares * (k * k));
    f.set_curvature(by_slope + Interval{std::max(straight.low, near.low), std::min(straight.high, near.high)});
    return f;
}

namespace detail {
/// Improves the enclosure of a convex function of the numbers x that increases with each of them and is 1-Lipschitz:
/// its derivatives with respect to them are weights from 0 to 1.
inline Enclosure tightened_by_convexity(Enclosure f, std::initializer_list<const Enclosure*> x) {
    double sum = 0;
    for (const Enclosure* e : x) sum += std::min(e->curvature.low, 0.0) * std::min(e->curvature.low, 0.0);
    f.curvature.low = std::max(f.curvature.low, std::max(-std::sqrt(sum), -Interval::most));
    f.value_curvature = f.value * f.curvature;
    for (std::size_t i = 0; i < 3; ++i) {
        Interval weighted{};
        for (const Enclosure* e : x) weighted = weighted + hull(e->gradient[i], {});
        f.gradient[i] = {std::max(f.gradient[i].low, weighted.low), std::min(f.gradient[i].high, weighted.high)};
    }
    return f;
}
}  // namespace detail

/// Where one operand is never positive, the result is the maximum of that operand and the corner of the others,
/// according to the template's equation. The function is also convex: outside, it is the largest sum of its operands
/// weighted by a unit vector without negative components.
inline Enclosure corner(const Enclosure& a, const Enclosure& b) {
    if (a.value.high <= 0 || b.value.high <= 0) return max(a, b);
    return detail::tightened_by_convexity(phasetree::corner<Enclosure>(a, b), {&a, &b});
}
inline Enclosure corner(const Enclosure& a, const Enclosure& b, const Enclosure& c) {
    if (a.value.high <= 0) return max(a, corner(b, c));
    if (b.value.high <= 0) return max(b, corner(a, c));
    if (c.value.high <= 0) return max(c, corner(a, b));
    return detail::tightened_by_convexity(phasetree::corner<Enclosure>(a, b, c), {&a, &b, &c});
}

/// The slopes of both operands agree on the seam, so the seam adds no curvature.
inline Enclosure select_smoothly(const Decision& d, const Enclosure& yes, const Enclosure& no) {
    Enclosure r = select(d, yes, no);
    r.set_curvature(!d.can_be_false  ? yes.curvature
                    : !d.can_be_true ? no.curvature
                                     : hull(yes.curvature, no.curvature));
    return r;
}

/// If a comparison is decided for the whole box, only one branch is evaluated.
template <class Yes, class No>
Enclosure choose_smoothly(const Decision& d, const Yes& yes, const No& no) {
    if (!d.can_be_false) return yes();
    if (!d.can_be_true) return no();
    return select_smoothly(d, yes(), no());
}

template <class Other>
Enclosure also_known_as(const Enclosure& f, const Other& other) {
    const auto [is_certain, g] = other([](const Decision& d) { return !d.can_be_false; });
    return is_certain ? g : f;
}

/// The squared distance to a convex set is convex, and no more curved than the squared distance to a point.
inline Enclosure squared_distance_to_segment(const Vec3<Enclosure>& q, const glm::vec3& along, float inverse) {
    Enclosure r = phasetree::squared_distance_to_segment<Enclosure>(q, along, inverse);
    const std::array<const Enclosure*, 3> x{&q.x, &q.y, &q.z};
    const double aside = 2 * std::sqrt(r.value.high) * detail::curvature_of(x);
    const Interval curvature = limited(-aside, 2 * detail::squared_stretch(x) + aside);
    r.set_curvature({std::max(r.curvature.low, curvature.low), std::min(r.curvature.high, curvature.high)});
    return r;
}

/// Improves the enclosure of a 1-Lipschitz function that is convex in q: its curvature is negative only as far as q
/// itself curves.
inline Enclosure known_to_be_convex(Enclosure f, const Vec3<Enclosure>& q) {
    const double aside = detail::curvature_of<3>({&q.x, &q.y, &q.z});
    f.curvature.low = std::max(f.curvature.low, -aside);
    f.value_curvature = f.value * f.curvature;
    return f;
}

/// The template's selection of quadrants looks like seams, but sine and cosine have none.
inline SineCosine<Enclosure> sine_cosine(const Enclosure& x) {
    SineCosine<Enclosure> r = phasetree::sine_cosine<Enclosure>(x);
    if (!(x.value.magnitude() < 1e4)) return r;
    const auto cut = [](const Interval& v) { return Interval{std::max(v.low, -1.0), std::min(v.high, 1.0)}; };
    const Interval s = cut(r.sine.value), c = cut(r.cosine.value);
    r.sine.set_curvature(c * x.curvature - s * detail::squares_of_slope(x));
    r.cosine.set_curvature(-s * x.curvature - c * detail::squares_of_slope(x));
    return r;
}

}  // namespace phasetree::enclosure
