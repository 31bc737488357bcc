// A simpler volume that replaces a field or an object away from it (paper, Sections 4.1 and 7.3; Hubert-Brierre et
// al., "Accelerating Signed Distance Functions", 2025). A bounding node that switches, "b > m ? b : f", jumps, and what
// is built on top of it is no longer 1-Lipschitz. This one does not (see "Fields above a discontinuity" in
// lib/README.md):
//
//     g(f) = max(b, min(f, 2m − b))
//
// With b and f, g is 1-Lipschitz. It is b where b ≥ m, whatever f is there. And g < 0 exactly where both b < 0 and f <
// 0, so it has the sign of f if the volume {b < 0} contains {f < 0}, and is the intersection of both if it does not. As
// g is 1-Lipschitz and has the right sign, it is never more than the distance to where the sign changes.
//
// g rises with f. So for an object of phases, in which one phase k is all that there is outside of the volume,
//
//     φᵢ ← g(φᵢ) for i ≠ k,    φₖ ← −g(−φₖ)
//
// keeps I2: φᵢ ≥ −φₖ gives g(φᵢ) ≥ g(−φₖ). Of two others one is not negative; if φᵢ < 0 < −φᵢ ≤ φⱼ then b < 0, and
// g(φᵢ) + g(φⱼ) is at least φᵢ + φⱼ or max(b, φᵢ) + 2m − b, both of which are not negative.
#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree::detail {

/// g(f()) above; f is called only if it matters and the number type can tell.
template <class T, class F>
T guarded_by(const T& b, float margin, const F& f) {
    return max(b, min(f(), 2 * margin - b));
}
/// 2m is exact and 2m − b is no more than m where b ≥ m, so that this is the value of the equation to the last bit.
template <class F>
float guarded_by(float b, float margin, const F& f) {
    return b >= margin ? b : max(b, min(f(), 2 * margin - b));
}

/// The object within a volume, with all outside of it in phase k, the vacuum perhaps, which the object may not have so
/// far. a() gives the object; `there` has its phases.
template <class T, class A>
Phases<T> object_guarded_by(const T& b, float margin, PhaseSet there, int k, const A& a) {
    const Phases<T> inner = a();
    Phases<T> result;
    result.set(k, -b);
    for_each_phase(there.bits, [&](int i) {
        const auto value = [&] { return i == k ? -inner[i] : inner[i]; };
        const T guarded = guarded_by(b, margin, value);
        result.set(i, i == k ? -guarded : guarded);
    });
    return result;
}
template <class A>
Phases<float> object_guarded_by(float b, float margin, PhaseSet there, int k, const A& a) {
    if (b < margin) return object_guarded_by<float, A>(b, margin, there, k, a);
    Phases<float> result;
    for_each_phase(there.bits, [&](int i) { result.set(i, b); });
    result.set(k, -b);
    return result;
}

inline constexpr Parameter guard_margin{
    "margin", "m", "How far from there the distance to it takes over. The child does not matter beyond.",
    limits::positive};

}  // namespace phasetree::detail
