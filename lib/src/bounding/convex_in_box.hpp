#pragma once

#include <cmath>
#include <optional>

#include "enclosure/length.hpp"
#include "math/dual.hpp"
#include "phasetree/model/concepts.hpp"

/// Bounds the distance to a rounded convex solid in a box, from its value and gradient at the centre alone. Suppose
/// that a ball of radius ρ touches the surface from inside at every surface point that is nearest to a point of the
/// box. Then the distance f bends no more than the distance to that ball. Along straight lines of unit speed,
///     0 ≤ f″ ≤ 1/(f + ρ).
/// This is both tighter and faster than interval arithmetic through the solid's equation.
namespace phasetree::bounding {

using enclosure::Enclosure, enclosure::limited;

/// A point that is an affine function of a box's points, with everything that enclose_convex() needs of it. Many solids
/// share the same point, so this is computed once for all of them.
struct AffinePoint {
    Vec3<Dual> at_centre;  ///< the point and its Jacobian at the box's centre, in floats
    glm::dvec3 centre;     ///< the same point in doubles
    double largest_coordinate;
    double squared_stretch, stretch;  ///< an upper bound on the Jacobian's norm, by which lengths grow at most
    Enclosure::Vector half;           ///< the half extents of the box
    double squared_radius, radius;    ///< half of the box's diagonal

    /// The point of the box itself.
    static AffinePoint of_box(const glm::dvec3& centre, const Enclosure::Vector& half) {
        const auto coordinate = [&](int i) {
            return Dual(static_cast<float>(centre[i]), i == 0 ? 1.f : 0.f, i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f);
        };
        return {{coordinate(0), coordinate(1), coordinate(2)}, centre, 1, half};
    }
    /// Returns nullopt if the point is not affine.
    static std::optional<AffinePoint> of(const Vec3<Enclosure>& q, const Enclosure::Vector& half) {
        const std::array<const Enclosure*, 3> x{&q.x, &q.y, &q.z};
        if (!enclosure::detail::are_affine(x)) return std::nullopt;
        const auto coordinate = [](const Enclosure& e) {
            return Dual(static_cast<float>(e.centre), static_cast<float>(e.gradient[0].low),
                        static_cast<float>(e.gradient[1].low), static_cast<float>(e.gradient[2].low));
        };
        const glm::dvec3 centre(q.x.centre, q.y.centre, q.z.centre);
        return AffinePoint({coordinate(q.x), coordinate(q.y), coordinate(q.z)}, centre,
                           enclosure::detail::squared_stretch_of_affine(x), half);
    }

  private:
    AffinePoint(const Vec3<Dual>& q, const glm::dvec3& c, double squared_norm, const Enclosure::Vector& h)
        : at_centre(q),
          centre(c),
          largest_coordinate(std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)})),
          squared_stretch(squared_norm),
          stretch(std::sqrt(squared_norm)),
          half(h),
          squared_radius(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]),
          radius(std::sqrt(squared_radius)) {}
};

/// Writes the enclosure of a solid's distance to `result`. False if the box may contain centres of these balls, where
/// the second derivative of the distance is unbounded.
///
/// Value and gradient are computed in floats, because enclosing spends most of its time here. The result is written in
/// place: copying it right after its numbers were written one by one would stall the processor.
template <RoundedPrimitive P>
bool enclose_convex(const P& solid, const AffinePoint& point, Enclosure& result) {
    const Dual f = solid.distance(point.at_centre);
    const glm::dvec3 slope(f.gradient());
    const auto value = static_cast<double>(f.value());

    // A convex function never lies below its tangent plane at the centre.
    double drop = 0;
    for (std::size_t i = 0; i < 3; ++i) drop += std::abs(slope[static_cast<int>(i)]) * point.half[i];
    const double least_radius = value - drop + solid.rolling_radius(point.centre, point.stretch * point.radius);
    if (!(least_radius > 0)) return false;
    const double inverse = 1 / least_radius, curvature = point.squared_stretch * inverse;
    // An upper bound on the rounding error of the gradient, from that of the centre's coordinates and its own.
    const double rounding_error = point.stretch * (4e-7 * point.largest_coordinate * inverse + 1e-6);

    result.centre = value;
    result.value = limited(value - drop, value + drop + 0.5 * curvature * point.squared_radius);
    for (std::size_t i = 0; i < 3; ++i) {
        const double g = slope[static_cast<int>(i)];
        // The eigenvalues of the second derivatives lie between 0 and `curvature`. So the matrix is half of that times
        // the identity, plus a matrix whose norm is at most half of it.
        const double change = 0.5 * curvature * (point.half[i] + point.radius) + rounding_error;
        result.gradient[i] = limited(g - change, g + change);
        result.centre_gradient[i] = g;
    }
    result.set_curvature(limited(0, curvature));
    return true;
}

}  // namespace phasetree::bounding
