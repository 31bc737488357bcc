#pragma once

#include "enclosure/number.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree::enclosure {

namespace detail {
/// An upper bound on |dx/dv|² for a vector x and any direction v of unit length. This is the largest eigenvalue of JᵀJ,
/// where J is the Jacobian. It is at most the largest row sum of absolute values of that matrix (Gershgorin).
template <std::size_t n>
double squared_stretch(const std::array<const Enclosure*, n>& x) {
    std::array<std::array<Interval, 3>, 3> squared{};
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
/// An upper bound on the length of the second derivative of a vector along any line.
template <std::size_t n>
double curvature_of(const std::array<const Enclosure*, n>& x) {
    double sum = 0;
    for (const Enclosure* e : x) sum += e->curvature.magnitude() * e->curvature.magnitude();
    return std::min(std::sqrt(sum), Interval::most);
}
/// Improves the gradient and curvature of f = |x|: f″ = (|x′|² − f′² + x·x″)/f with 0 ≤ f′² ≤ |x′|².
template <std::size_t n>
Enclosure with_curvature_of_length(Enclosure f, const std::array<const Enclosure*, n>& x) {
    Interval along{};
    for (const Enclosure* e : x) along = along + e->value_curvature;
    const double stretch = squared_stretch(x), steepest = std::min(std::sqrt(stretch), Interval::most);
    for (Interval& g : f.gradient) g = {std::max(g.low, -steepest), std::min(g.high, steepest)};
    const Interval product = limited(0, stretch) + along;
    if (!(f.value.low > 0)) {
        f.value_curvature = product;
        return f;
    }
    const Interval curvature = product * reciprocal(f.value);
    f.set_curvature({std::max(f.curvature.low, curvature.low), std::min(f.curvature.high, curvature.high)});
    return f;
}
/// Like squared_stretch(), for a vector with constant gradients.
template <std::size_t n>
double squared_stretch_of_affine(const std::array<const Enclosure*, n>& x) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            double product = 0;
            for (const Enclosure* e : x) product += e->gradient[i].low * e->gradient[j].low;
            row += std::abs(product);
        }
        most = std::max(most, row);
    }
    return most;
}
/// Whether the gradients of all these numbers are constant, as those of a point's coordinates usually are.
template <std::size_t n>
bool are_affine(const std::array<const Enclosure*, n>& x) {
    double width = 0;
    for (const Enclosure* e : x) {
        width += std::abs(e->curvature.low) + std::abs(e->curvature.high);
        for (const Interval& g : e->gradient) width += std::abs(g.high - g.low);
    }
    return width == 0;
}
/// The length of a vector with constant gradients, computed without its square as an intermediate result. Arrays have
/// four numbers for three axes, so that loops fit vector registers.
template <std::size_t n>
Enclosure length_of_affine(const std::array<const Enclosure*, n>& x) {
    using Axes = std::array<double, 4>;
    std::array<Axes, n> slope;
    Interval squared{};
    double at_centre = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const Enclosure& e = *x[k];
        const Interval s = square(e.value);
        squared.low += s.low;
        squared.high += s.high;
        at_centre += e.centre * e.centre;
        slope[k] = {e.gradient[0].low, e.gradient[1].low, e.gradient[2].low, 0};
    }
    std::array<Axes, 3> product{};  // JᵀJ, where J is the Jacobian
    Axes low{}, high{}, middle{};   // Jᵀx: its range in the box, and at the centre
    for (std::size_t k = 0; k < n; ++k) {
        const Enclosure& e = *x[k];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 4; ++j) product[i][j] += slope[k][i] * slope[k][j];
        for (std::size_t j = 0; j < 4; ++j) {
            const double one = e.value.low * slope[k][j], other = e.value.high * slope[k][j];
            low[j] += one < other ? one : other;
            high[j] += one < other ? other : one;
            middle[j] += e.centre * slope[k][j];
        }
    }
    Enclosure f;
    f.centre = std::sqrt(at_centre);
    f.value = limited(std::sqrt(squared.low), std::sqrt(squared.high));
    double stretch = 0;
    for (const Axes& row : product) stretch = std::max(stretch, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
    const Interval inverse = f.value.low > 0 ? limited(1 / f.value.high, 1 / f.value.low)
                                             : limited(f.value.high > 0 ? 1 / f.value.high : 0, Interval::most);
    // The inverse is positive.
    const auto times_inverse = [&](double l, double h) {
        return limited(l < 0 ? l * inverse.high : l * inverse.low, h > 0 ? h * inverse.high : h * inverse.low);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const double steepest = std::sqrt(product[i][i]);
        const Interval g = times_inverse(std::max(low[i], -Interval::most), std::min(high[i], Interval::most));
        f.gradient[i] = {std::max(g.low, -steepest), std::min(g.high, steepest)};
        f.centre_gradient[i] = f.centre > 0 ? middle[i] / f.centre : 0;
    }
    const Interval bends = limited(0, stretch);
    f.curvature = f.value.low > 0 ? bends * inverse : limited(0, Interval::most);
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

}  // namespace phasetree::enclosure
