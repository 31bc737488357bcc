// Shared code of smooth intersection and difference of one phase with a shape (Galin et al., Section 5.3). g is the
// field of what is kept:
//
//     Bₖ = {s < 0},  s = −smin(−aₖ, −g);    Bᵢ = Aᵢ;    vacuum: A₀ ∪ (Aₖ − Bₖ).
//
// Unlike smooth_unite_shape, this operator needs no variants over and under the other phases, because both would be
// equal: s ≥ max(aₖ, g), so Bₖ is a part of Aₖ, which no other phase overlaps. So max(aᵢ, −s) = aᵢ, because −s ≤ −aₖ ≤
// aᵢ, and max(s, −min aᵢ) = s, because −aᵢ ≤ aₖ ≤ s.
//
// Aₖ − Bₖ is max(aₖ, −s), or equally max(aₖ, −s, −g − r): within Aₖ, s ≥ 0 requires g > −r, because the edge is rounded
// nowhere else. The additional term prevents a zero of φ₀ where two parts of Aₖ abut, so that aₖ is 0 inside it, far
// from the shape's surface. It gives the sharp operator's max(aₖ, −g) as r → 0.
//
//     φ₀ = min(a₀, max(aₖ, −s, −g − r))
//
// I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): φₖ + φ₀ ≥ min(aₖ + a₀, s − s),  φₖ + aᵢ ≥ aₖ + aᵢ,  φ₀ + aᵢ ≥ min(a₀ + aᵢ, aₖ + aᵢ).
#pragma once

#include "phasetree/nodes/fields/fold.hpp"
#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree::detail {

template <class S>
Phases<S> smooth_cut(Phases<S> a, int k, const S& kept, float radius) {
    const S s = smooth_max(a[k], kept, radius);
    const S gone = max(max(a[k], -s), -kept - radius);
    a.set(k, s);
    a.set(0, a.has(0) ? min(a[0], gone) : gone);
    return a;
}
inline PhaseSet smooth_cut_phases(const Phased& of, Phase phase) {
    const PhaseSet there = phasetree::phases(of);
    return there.contains(phase) ? there | PhaseSet::of(vacuum) : there;
}
inline constexpr Parameter smooth_cut_object{"of", "", "The object."};
inline constexpr Parameter smooth_cut_phase{"phase", "", "The phase to cut."};

}  // namespace phasetree::detail
