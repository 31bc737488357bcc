#pragma once

/// Warps. λ is taken from the node; the tests of slopes check that it is large enough.

#include "support/set_algebra/components.hpp"
#include "support/set_algebra/primitives.hpp"
#include "support/set_algebra/transforms.hpp"

namespace phasetree::tests::oracle {

template <class W, class Child>
double to_bound(const Warped<W, Child>& n, const dvec3& p) {
    return box(p - dvec3(n.bound.centre), dvec3(n.bound.half));
}

template <class W>
bool member(const WarpedField<W>& n, const dvec3& p) {
    return inside(n.of, back(n.warp, p));
}
template <class W>
Phase region(const WarpedPhased<W>& n, const dvec3& p) {
    const Phase there = label(n.of, back(n.warp, p)), here = label(n.of, p);
    const PhaseSet chosen = n.over | n.under;
    if (chosen.empty()) return there;
    const Phase moved = chosen.contains(there) ? there : vacuum, rest = chosen.contains(here) ? vacuum : here;
    if (n.under.empty()) return moved == vacuum ? rest : moved;
    return rest == vacuum ? moved : rest;
}
/// A local warp is evaluated at the nearest point of its bounds, and the distance to them takes over where it is
/// larger.
template <class N>
dvec3 evaluated_at(const N& n, const dvec3& p) {
    if constexpr (LocalWarp<decltype(n.warp)>) {
        const dvec3 centre(n.bound.centre), half(n.bound.half);
        const dvec3 within = glm::clamp(p, centre - half, centre + half);
        if constexpr (requires { extended(n.warp, within); })
            return extended(n.warp, within);
        else
            return back(n.warp, within);
    } else {
        return back(n.warp, p);
    }
}
template <class W>
double signed_value(const WarpedField<W>& n, const dvec3& p) {
    const double f = value(n.of, evaluated_at(n, p)) * n.warp.value_scale();
    if constexpr (LocalWarp<W>) return std::max(f, to_bound(n, p));
    return f;
}
template <class W>
Components components(const WarpedPhased<W>& n, const dvec3& p) {
    Components a = values(n.of, evaluated_at(n, p));
    for (std::size_t i = 0; i < Components::size; ++i) {
        if (!(a[i] < absent)) continue;
        a[i] *= n.warp.value_scale();
        if constexpr (LocalWarp<W>) a[i] = i == 0 ? std::min(a[i], -to_bound(n, p)) : std::max(a[i], to_bound(n, p));
    }
    const PhaseSet chosen = n.over | n.under;
    if (chosen.empty()) return a;
    a = without(a, PhaseSet{~chosen.bits});
    const Components rest = without(values(n.of, p), chosen);
    return n.under.empty() ? replaced(rest, a) : replaced(a, rest);
}

}  // namespace phasetree::tests::oracle
