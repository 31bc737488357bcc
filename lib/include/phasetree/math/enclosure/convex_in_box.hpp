#pragma once

#include <cmath>
#include <optional>

#include "phasetree/math/dual.hpp"
#include "phasetree/math/enclosure/length.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The distance to a convex solid by its value and gradient at the box's centre, where the point is an affine function
/// of the box's points; nothing if its skeleton is too near. With a ball of radius ρ inside, where it touches the
/// surface, f bends no more than the distance to that ball: along straight lines of unit speed 0 ≤ f″ ≤ 1/(f + ρ).
///
/// Value and gradient are computed in floats, because that is where boxes' time goes.
template <RoundedPrimitive P>
std::optional<Enclosure> convex_in_box(const P& solid, const Vec3<Enclosure>& q, const Enclosure::Vector& half) {
    const std::array<const Enclosure*, 3> x{&q.x, &q.y, &q.z};
    if (!detail::are_affine(x)) return std::nullopt;
    const auto number = [](const Enclosure& e) {
        return Dual(static_cast<float>(e.centre), static_cast<float>(e.gradient[0].low),
                    static_cast<float>(e.gradient[1].low), static_cast<float>(e.gradient[2].low));
    };
    const Dual f = solid.distance(Vec3<Dual>{number(q.x), number(q.y), number(q.z)});
    const glm::dvec3 slope(f.gradient()), centre(q.x.centre, q.y.centre, q.z.centre);
    const auto value = static_cast<double>(f.value());

    // Convex: nowhere below the plane that touches it at the centre.
    double below = 0, squared_reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        below += std::abs(slope[static_cast<int>(i)]) * half[i];
        squared_reach += half[i] * half[i];
    }
    const double squared_stretch = detail::squared_stretch_of_affine(x), stretch = std::sqrt(squared_stretch);
    const double reach = std::sqrt(squared_reach);
    const double nearest = value - below + solid.rolling_radius(centre, stretch * reach);
    if (!(nearest > 0)) return std::nullopt;
    const double bend = squared_stretch / nearest;
    // What floats lose, of the centre and of the gradient itself.
    const double size = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
    const double lost = stretch * (4e-7 * size / nearest + 1e-6);

    Enclosure e;
    e.centre = value;
    e.value = limited(value - below, value + below + 0.5 * bend * squared_reach);
    for (std::size_t i = 0; i < 3; ++i) {
        const double g = slope[static_cast<int>(i)];
        // By second derivatives whose eigenvalues are within bend/2 of bend/2.
        const double turn = 0.5 * bend * (half[i] + reach) + lost;
        e.gradient[i] = limited(g - turn, g + turn);
        e.centre_gradient[i] = g;
    }
    e.set_curvature(limited(0, bend));
    return e;
}

}  // namespace phasetree
