#pragma once

#include <cmath>
#include <cstring>

#include "bounding/convex_in_box.hpp"
#include "bounding/network_in_box.hpp"
#include "enclosure/enclosure.hpp"
#include "evaluation/interpret.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::bounding {

using enclosure::enclose, enclosure::Range, enclosure::Region, enclosure::within;
using rewriting::Arena, rewriting::LocalValue;

/// The value at a centre of a long primitive of which little matters in the box; what that is, or nothing, is kept.
/// `of` is what it was in a box around.
template <LocalPrimitive P>
float local_value(const float* constants, const Region& at, std::span<const float> of, LocalValue& kept,
                  Arena& scratch) {
    P primitive;
    std::memcpy(static_cast<void*>(&primitive), constants, sizeof primitive);
    std::vector<float> floats;
    if (!primitive.specialise(at, of, floats)) return primitive.distance(at.point());
    kept = LocalValue::of<P>(scratch.copy(std::span<const float>(floats)));
    return P::Specialised::distance(kept.data.data(), at.point());
}

/// A long primitive. Of networks and noise, where they are not cut off, there is more to know; of others (an image,
/// Voronoi cells) only their slope is used, at most 1 in their own space.
template <class P>
Enclosure enclose_long_primitive(const float* constants, const Vec3<Enclosure>& q, const Enclosure::Vector& half,
                                 std::span<const float> of, LocalValue& kept, Arena& scratch) {
    const Region at(q);
    if constexpr (std::is_same_v<P, Siren::Network>) {
        if (at.farthest() < static_cast<double>(constants[1]))
            return enclose(network_in_box(constants, at.centre, at.reach), at);
    }
    if constexpr (std::is_same_v<P, FractalNoise>) return program::distance_of<P>(constants, q);
    double value = 0;
    if constexpr (LocalPrimitive<P>)
        value = static_cast<double>(local_value<P>(constants, at, of, kept, scratch));
    else
        value = static_cast<double>(program::distance_of<P>(constants, at.point()));
    const auto slope = enclosure::detail::each_axis([&](std::size_t i) {
        return within(
            std::hypot(q.x.gradient[i].magnitude(), q.y.gradient[i].magnitude(), q.z.gradient[i].magnitude()));
    });
    return Enclosure(value, Range::all(), slope, enclosure::detail::no_gradient, Range::all()).tightened(half);
}

/// One that is not, by its equation.
template <class P>
Enclosure enclose_primitive(const float* constants, const Vec3<Enclosure>& q) {
    const Enclosure e = program::distance_of<P>(constants, q);
    if constexpr (ConvexPrimitive<P>)
        return known_to_be_convex(e, q);
    else
        return e;
}

}  // namespace phasetree::bounding
