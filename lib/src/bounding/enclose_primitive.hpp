#pragma once

#include <limits>

#include "bounding/convex_in_box.hpp"
#include "enclosure/enclosure.hpp"
#include "enclosure/field_in_box.hpp"
#include "evaluation/interpret.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::bounding {

using enclosure::enclose_lipschitz, enclosure::Interval, enclosure::Region;
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

/// The enclosure of a long primitive, as it states itself (phasetree/model/enclosing.hpp). A local primitive is
/// enclosed as its specialisation is.
template <class P>
Enclosure enclose_long_primitive(const float* constants, const Vec3<Enclosure>& q, const Enclosure::Vector& half,
                                 SpecialisationInBox& specialisation) {
    if constexpr (AnyLocalPrimitive<P>) {
        using Stated = typename EnclosingOf<typename P::Specialised>::Stated;
        const auto value = static_cast<double>(value_by_specialisation<P>(constants, Region(q), specialisation));
        if constexpr (EnclosesItself<Stated>)
            if (const float* data = specialisation.found.data.data())
                if (const auto known = Stated::enclosed(data, q, half)) return *known;
        return enclose_lipschitz(value, Interval::all(), q, half);
    } else {
        using Stated = typename EnclosingOf<P>::Stated;
        static_assert(StatesEnclosing<Stated>,
                      "a long primitive must state how it is enclosed (phasetree/model/enclosing.hpp)");
        if constexpr (EnclosesItself<Stated>) {
            if (const auto known = Stated::enclosed(constants, q, half)) return *known;
        } else if constexpr (Stated::enclosed_by == EnclosedBy::equation) {
            return program::distance_of<P>(constants, q);
        }
        const auto value = static_cast<double>(program::distance_of<P>(constants, Region(q).point()));
        return enclose_lipschitz(value, Interval::all(), q, half);
    }
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
