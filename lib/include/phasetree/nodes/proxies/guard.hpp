// A simpler volume that replaces a field or an object at points away from that volume (Galin et al., Sections 4.1 and
// 7.3; Hubert-Brierre et al., "Accelerating Signed Distance Functions", 2025). A bounding node that switches, "b > m ?
// b : f", is discontinuous, and anything built on it is no longer 1-Lipschitz. This one stays 1-Lipschitz (see "Fields
// above a discontinuity" in lib/README.md):
//
//     g(f) = max(b, min(f, 2m − b))
//
// If b and f are 1-Lipschitz, so is g. It is b where b ≥ m, whatever f is there. g < 0 exactly where both b < 0 and f <
// 0. So it has the sign of f if the volume {b < 0} contains {f < 0}, and is the intersection of both otherwise. Because
// g is 1-Lipschitz and has the right sign, it never exceeds the distance to the surface.
//
// g increases with f. For an object in which one phase k fills everything outside the volume,
//
//     φᵢ ← g(φᵢ) for i ≠ k,    φₖ ← −g(−φₖ)
//
// therefore preserves I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): φᵢ ≥ −φₖ gives g(φᵢ) ≥ g(−φₖ). Of two other phases i and j, at least
// one is not negative. If φᵢ < 0 < −φᵢ ≤ φⱼ, then b < 0, and g(φᵢ) + g(φⱼ) is at least φᵢ + φⱼ or max(b, φᵢ) + 2m − b,
// neither of which is negative.
#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree::detail {

/// g(f()) from above. f is called only if its value can matter; number types that cannot decide this always call it.
template <class T, class F>
T guarded_by(const T& b, float margin, const F& f) {
    return max(b, min(f(), 2 * margin - b));
}
/// 2m is exact, and 2m − b ≤ m where b ≥ m, so this equals the equation to the last bit.
template <class F>
float guarded_by(float b, float margin, const F& f) {
    return b >= margin ? b : max(b, min(f(), 2 * margin - b));
}

/// The object within a volume, with phase k everywhere outside. k may be the vacuum, and the object need not have it.
/// a() returns the object, and `there` are the phases that it has.
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
    "margin", "m",
    "Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child.",
    limits::positive};

}  // namespace phasetree::detail
