#pragma once

#include "phasetree/math/enclosure/number.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree {

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

}  // namespace phasetree
