#pragma once

#include <cmath>
#include <limits>

#include "bounding/balls_in_box.hpp"
#include "bounding/convex_in_box.hpp"
#include "bounding/mesh_in_box.hpp"
#include "bounding/network_in_box.hpp"
#include "bounding/voxels_in_box.hpp"
#include "enclosure/enclosure.hpp"
#include "evaluation/interpret.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::bounding {

using enclosure::enclose, enclosure::Interval, enclosure::Region, enclosure::within;
using rewriting::Arena, rewriting::Specialisation;

/// The specialisation of a local primitive in the box in which it is enclosed.
struct SpecialisationInBox {
    std::span<const float> around;  ///< the data of its specialisation in the surrounding box, or empty
    Arena& scratch;
    double farthest = std::numeric_limits<double>::infinity();  ///< larger values are not required
    Specialisation found{};                                     ///< the specialisation found by enclosing; its data are
                                                                ///< in `scratch`
};

/// The value of a local primitive at the centre of a region, from its specialisation there if it has one.
template <AnyLocalPrimitive P>
float value_by_specialisation(const float* constants, const Region& at, SpecialisationInBox& specialisation) {
    std::vector<float> floats;
    const bool is_special = [&] {
        if constexpr (RequiredDataPrimitive<P>)
            return P::specialise(constants, at, specialisation.farthest, specialisation.around, floats);
        else if constexpr (LocalDataPrimitive<P>)
            return P::specialise(constants, at, specialisation.around, floats);
        else
            return program::read<P>(constants).specialise(at, specialisation.around, floats);
    }();
    if (!is_special) return program::distance_of<P>(constants, at.point());
    Specialisation& found = specialisation.found;
    found = Specialisation::of<P>(specialisation.scratch.copy(std::span<const float>(floats)));
    return P::Specialised::distance(found.data.data(), at.point());
}

/// The enclosure of a long primitive:
///  - Noise has its own enclosure. So has a network inside its cube; beyond the cube, points are projected onto it
///    (Siren::Network).
///  - The few mesh pieces in a small box bound the gradient, and so do a few voxels. More voxels only bound the range
///    of values.
///  - A few balls are enclosed one by one.
///  - For all others (images, Voronoi cells), and for the above elsewhere, only the value at the centre is used,
///    together with the Lipschitz bound of 1 in their own space.
template <class P>
Enclosure enclose_long_primitive(const float* constants, const Vec3<Enclosure>& q, const Enclosure::Vector& half,
                                 SpecialisationInBox& specialisation) {
    const Region at(q);
    if constexpr (std::is_same_v<P, Siren::Network>) {
        // The second number of a network's data is half the side of the cube.
        const auto half_of_cube = static_cast<double>(constants[1]);
        if (at.farthest() < half_of_cube) return enclose(network_in_box(constants, at.centre, at.half_extents), at);
    }
    if constexpr (std::is_same_v<P, FractalNoise>) return program::distance_of<P>(constants, q);
    double value = 0;
    if constexpr (AnyLocalPrimitive<P>)
        value = static_cast<double>(value_by_specialisation<P>(constants, at, specialisation));
    else
        value = static_cast<double>(program::distance_of<P>(constants, at.point()));
    const float* balls = nullptr;
    if constexpr (std::is_same_v<P, Balls::Specialised>) balls = constants;
    if constexpr (std::is_same_v<P, Balls>) balls = specialisation.found.data.data();
    if (balls)
        if (const auto known = balls_in_box(balls, q, half)) return *known;
    const float* pieces = nullptr;
    if constexpr (std::is_same_v<P, Mesh::Specialised>) pieces = constants;
    if constexpr (std::is_same_v<P, Mesh>) pieces = specialisation.found.data.data();
    if (pieces)
        if (const auto known = mesh_in_box(pieces, at)) return enclose(*known, at).tightened(half);
    Interval values = Interval::all();
    if constexpr (std::is_same_v<P, Volume::Samples> || std::is_same_v<P, Labels::Depth>) {
        const VoxelsInBox known = voxels_in_box(constants, at, std::is_same_v<P, Labels::Depth>);
        if (known.field) return enclose(*known.field, at).tightened(half);
        values = known.values;
    }
    const auto slope = enclosure::detail::each_axis([&](std::size_t i) {
        return within(
            std::hypot(q.x.gradient[i].magnitude(), q.y.gradient[i].magnitude(), q.z.gradient[i].magnitude()));
    });
    return Enclosure(value, values, slope, enclosure::detail::no_gradient, Interval::all()).tightened(half);
}

/// The enclosure of any other primitive, from its equation.
template <class P>
Enclosure enclose_primitive(const float* constants, const Vec3<Enclosure>& q) {
    const Enclosure e = program::distance_of<P>(constants, q);
    if constexpr (ConvexPrimitive<P>)
        return known_to_be_convex(e, q);
    else
        return e;
}

}  // namespace phasetree::bounding
