#pragma once

#include <cmath>
#include <optional>

#include "enclosure/length.hpp"
#include "math/dual.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree::bounding {

using enclosure::Enclosure, enclosure::limited;

/// A point that is an affine function of a box's points: what convex solids need of it, worked out once for all of
/// them.
struct AffinePoint {
    Vec3<Dual> number;  ///< at the box's centre
    glm::dvec3 centre;
    double size;                      ///< of the centre's largest coordinate
    double squared_stretch, stretch;  ///< of its Jacobian at most
    Enclosure::Vector half;           ///< the box's half extents,
    double squared_reach, reach;      ///< and how long they are

    /// A box's own.
    static AffinePoint of_box(const glm::dvec3& centre, const Enclosure::Vector& half) {
        const auto number = [&](int i) {
            return Dual(static_cast<float>(centre[i]), i == 0 ? 1.f : 0.f, i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f);
        };
        return {{number(0), number(1), number(2)}, centre, 1, half};
    }
    /// Nothing if it is not affine.
    static std::optional<AffinePoint> of(const Vec3<Enclosure>& q, const Enclosure::Vector& half) {
        const std::array<const Enclosure*, 3> x{&q.x, &q.y, &q.z};
        if (!enclosure::detail::are_affine(x)) return std::nullopt;
        const auto number = [](const Enclosure& e) {
            return Dual(static_cast<float>(e.centre), static_cast<float>(e.gradient[0].low),
                        static_cast<float>(e.gradient[1].low), static_cast<float>(e.gradient[2].low));
        };
        const glm::dvec3 centre(q.x.centre, q.y.centre, q.z.centre);
        return AffinePoint({number(q.x), number(q.y), number(q.z)}, centre,
                           enclosure::detail::squared_stretch_of_affine(x), half);
    }

  private:
    AffinePoint(const Vec3<Dual>& q, const glm::dvec3& c, double stretched, const Enclosure::Vector& h)
        : number(q),
          centre(c),
          size(std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)})),
          squared_stretch(stretched),
          stretch(std::sqrt(stretched)),
          half(h),
          squared_reach(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]),
          reach(std::sqrt(squared_reach)) {}
};

/// The distance to a convex solid by its value and gradient at the box's centre, into e; false if its skeleton is too
/// near. With a ball of radius ρ inside, where it touches the surface, f bends no more than the distance to that ball:
/// along straight lines of unit speed 0 ≤ f″ ≤ 1/(f + ρ).
///
/// Value and gradient are computed in floats, because that is where boxes' time goes; so is waiting for a copy of what
/// was just written number by number, hence e.
template <RoundedPrimitive P>
bool enclose_convex(const P& solid, const AffinePoint& at, Enclosure& e) {
    const Dual f = solid.distance(at.number);
    const glm::dvec3 slope(f.gradient());
    const auto value = static_cast<double>(f.value());

    // Convex: nowhere below the plane that touches it at the centre.
    double below = 0;
    for (std::size_t i = 0; i < 3; ++i) below += std::abs(slope[static_cast<int>(i)]) * at.half[i];
    const double nearest = value - below + solid.rolling_radius(at.centre, at.stretch * at.reach);
    if (!(nearest > 0)) return false;
    const double inverse = 1 / nearest, bend = at.squared_stretch * inverse;
    // What floats lose, of the centre and of the gradient itself.
    const double lost = at.stretch * (4e-7 * at.size * inverse + 1e-6);

    e.centre = value;
    e.value = limited(value - below, value + below + 0.5 * bend * at.squared_reach);
    for (std::size_t i = 0; i < 3; ++i) {
        const double g = slope[static_cast<int>(i)];
        // By second derivatives whose eigenvalues are within bend/2 of bend/2.
        const double turn = 0.5 * bend * (at.half[i] + at.reach) + lost;
        e.gradient[i] = limited(g - turn, g + turn);
        e.centre_gradient[i] = g;
    }
    e.set_curvature(limited(0, bend));
    return true;
}

}  // namespace phasetree::bounding
