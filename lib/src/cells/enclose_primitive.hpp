#pragma once

#include <cmath>
#include <cstring>

#include "phasetree/math/dual.hpp"
#include "phasetree/math/enclosure.hpp"
#include "phasetree/math/enclosure/network_in_box.hpp"
#include "program/interpret.hpp"

/// Primitives that are no formula but a loop over data, in a box.
namespace phasetree {

/// Where the point that a primitive is given may be: about a centre, so far along each axis.
struct Region {
    std::array<const Enclosure*, 3> x;
    Enclosure::Vector centre{}, reach{};

    explicit Region(const Vec3<Enclosure>& q) : x{&q.x, &q.y, &q.z} {
        for (std::size_t i = 0; i < 3; ++i) {
            centre[i] = x[i]->centre;
            reach[i] = std::max(x[i]->value.high - centre[i], centre[i] - x[i]->value.low);
        }
    }
    double farthest() const {
        return std::max({x[0]->value.magnitude(), x[1]->value.magnitude(), x[2]->value.magnitude()});
    }
    Vec3<float> point() const {
        return {static_cast<float>(centre[0]), static_cast<float>(centre[1]), static_cast<float>(centre[2])};
    }
};

/// What a field that is known there is as a function of the box's points.
inline Enclosure enclose(const FieldInBox& f, const Region& at, const Enclosure::Vector& half) {
    Enclosure e;
    e.centre = f.value;
    double change = 0, squared_slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double steepest = f.gradients[i].magnitude();
        change += steepest * at.reach[i];
        squared_slope += steepest * steepest;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            e.gradient[axis] = e.gradient[axis] + f.gradients[i] * at.x[i]->gradient[axis];
            e.centre_gradient[axis] += f.gradient[i] * at.x[i]->centre_gradient[axis];
        }
    }
    e.value = limited(f.value - change, f.value + change);
    const double bent = std::sqrt(squared_slope) * detail::curvature_of(at.x);
    e.set_curvature(hull(f.curvature, {}) * detail::squared_stretch(at.x) + within(bent));
    return e.tightened(half);
}

/// Noise by its gradient at the centre and how much it bends.
inline FieldInBox noise_in_box(const FractalNoise& noise, const Region& at) {
    const Vec3<float> p = at.point();
    const Dual f = noise.distance(Vec3<Dual>{Dual(p.x, 1, 0, 0), Dual(p.y, 0, 1, 0), Dual(p.z, 0, 0, 1)});
    const double bend = noise.curvature(), change = bend * std::hypot(at.reach[0], at.reach[1], at.reach[2]);
    FieldInBox result;
    result.value = static_cast<double>(f.value());
    result.curvature = within(bend);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto g = static_cast<double>(f.gradient()[static_cast<int>(i)]);
        result.gradient[i] = g;
        result.gradients[i] = {std::max(-1.0, g - change), std::min(1.0, g + change)};
    }
    return result;
}

/// A long primitive. Of networks and noise, where they are not cut off, there is more to know; of others (an image,
/// Voronoi cells) only their slope is used, at most 1 in their own space.
template <class P>
Enclosure enclose_long_primitive(const float* constants, const Vec3<Enclosure>& q, const Enclosure::Vector& half) {
    const Region at(q);
    if constexpr (std::is_same_v<P, Siren::Network>) {
        if (at.farthest() < static_cast<double>(constants[1]))
            return enclose(network_in_box(constants, at.centre, at.reach), at, half);
    }
    if constexpr (std::is_same_v<P, FractalNoise>) {
        FractalNoise noise;
        std::memcpy(static_cast<void*>(&noise), constants, sizeof noise);
        if (noise.is_within_cube(at.farthest())) return enclose(noise_in_box(noise, at), at, half);
    }
    const auto value = static_cast<double>(detail::distance_of<P>(constants, at.point()));
    const auto slope = detail::each_axis([&](std::size_t i) {
        return within(
            std::hypot(q.x.gradient[i].magnitude(), q.y.gradient[i].magnitude(), q.z.gradient[i].magnitude()));
    });
    return Enclosure(value, Range::all(), slope, detail::no_gradient, Range::all()).tightened(half);
}

}  // namespace phasetree
