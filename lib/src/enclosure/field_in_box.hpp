#pragma once

#include <array>
#include <cmath>

#include "enclosure/interval.hpp"
#include "enclosure/length.hpp"
#include "enclosure/number.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::enclosure {

/// Proven bounds of a field in a box, up to the rounding errors of doubles.
struct FieldInBox {
    double value = 0;                     ///< at the box's centre
    std::array<double, 3> gradient{};     ///< at the box's centre
    std::array<Interval, 3> gradients{};  ///< anywhere in the box
    Interval curvature{};                 ///< d²f/dt² along straight lines of unit speed
    Interval values = Interval::all();    ///< what is known of the value, apart from what follows from the gradients
};

/// The region that contains the point at which a field is evaluated, if its coordinates are given as enclosures.
struct Region : PointRange {
    std::array<const Enclosure*, 3> x;

    explicit Region(const Vec3<Enclosure>& q) : x{&q.x, &q.y, &q.z} {
        for (std::size_t i = 0; i < 3; ++i) {
            centre[i] = x[i]->centre;
            half_extents[i] = std::max(x[i]->value.high - centre[i], centre[i] - x[i]->value.low);
        }
    }
    /// The largest absolute value of a coordinate.
    double farthest() const {
        return std::max({x[0]->value.magnitude(), x[1]->value.magnitude(), x[2]->value.magnitude()});
    }
    /// The centre.
    Vec3<float> point() const {
        return {static_cast<float>(centre[0]), static_cast<float>(centre[1]), static_cast<float>(centre[2])};
    }
};

/// The enclosure of f(q), where f is known in the region of q, and q is known as a function of the box's points. Along
/// a line, (f∘q)″ = q′ᵀf″q′ + f′·q″.
inline Enclosure enclose(const FieldInBox& f, const Region& at) {
    Enclosure e;
    e.centre = f.value;
    double change = 0, squared_slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double steepest = f.gradients[i].magnitude();
        change += steepest * at.half_extents[i];
        squared_slope += steepest * steepest;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            e.gradient[axis] = e.gradient[axis] + f.gradients[i] * at.x[i]->gradient[axis];
            e.centre_gradient[axis] += f.gradient[i] * at.x[i]->centre_gradient[axis];
        }
    }
    e.value = limited(std::max(f.value - change, f.values.low), std::min(f.value + change, f.values.high));
    const double bent = std::sqrt(squared_slope) * detail::curvature_of(at.x);
    // |q′|² lies between zero and its upper bound, so q′ᵀf″q′ lies between zero and the curvature times this bound.
    e.set_curvature(hull(f.curvature, {}) * detail::squared_stretch(at.x) + within(bent));
    return e;
}

/// The enclosure of f(q), where f is 1-Lipschitz in its own space: from its value at the centre of q's region, and from
/// its known range there. `half` contains the half extents of the box in which q varies.
inline Enclosure enclose_lipschitz(double value, const Interval& values, const Vec3<Enclosure>& q,
                                   const Enclosure::Vector& half) {
    const auto slope = detail::each_axis([&](std::size_t i) {
        return within(
            portable::hypot(q.x.gradient[i].magnitude(), q.y.gradient[i].magnitude(), q.z.gradient[i].magnitude()));
    });
    return Enclosure(value, values, slope, detail::no_gradient, Interval::all()).tightened(half);
}

}  // namespace phasetree::enclosure
