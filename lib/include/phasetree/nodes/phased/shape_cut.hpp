// Shared code of intersection and difference with a shape, for all phases or some of them (Galin et al., Section 5.1).
//
// The vacuum grows by what is cut away: φ₀ = min(a₀, max(aₖ, g) over the cut phases k). g = −f, where f is the field of
// what is kept, so the inside of g is what is removed. If all phases are cut, this is min(a₀, g), because points
// outside all of them are vacuum anyway.
#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree::detail {

/// Cut the chosen phases to where kept ≤ 0. Vacuum replaces what is cut away.
template <class S>
Phases<S> cut(const Phases<S>& a, const S& kept, PhaseSet chosen) {
    Phases<S> result;
    if (chosen.empty() || (a.materials() & ~chosen.bits) == 0) {
        const S gone = -kept;
        result.set(0, a.has(0) ? min(a[0], gone) : gone);
        for_each_phase(a.materials(), [&](int i) { result.set(i, max(a[i], kept)); });
        return result;
    }
    result = a;
    for_each_phase(a.materials() & chosen.bits, [&](int i) {
        const S gone = max(a[i], -kept);
        result.set(0, result.has(0) ? min(result[0], gone) : gone);
        result.set(i, max(a[i], kept));
    });
    return result;
}

/// Vacuum is added to the phases only if one of the object's phases is cut.
inline PhaseSet phases_after_cut(PhaseSet there, PhaseSet chosen) {
    return chosen.empty() || (there.bits & chosen.bits & ~std::uint64_t{1}) != 0 ? there | PhaseSet::of(vacuum) : there;
}

inline constexpr Parameter cut_object{"of", "", "The object."};
inline constexpr Parameter cut_phases{"phases", "", "The phases to cut; by default all.", limits::any, true};

}  // namespace phasetree::detail
