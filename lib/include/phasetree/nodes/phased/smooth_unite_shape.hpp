#pragma once

#include "phasetree/nodes/fields/fold.hpp"
#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

namespace detail {
/// The smooth union s of phase k of A with a shape.
template <class S>
S blended_with(const Phases<S>& a, int k, const S& f, float radius) {
    return a.has(k) ? smooth_min(a[k], f, radius) : f;
}
inline Bounds blended_bounds(BoundsQuery& q, const Phased& of, const Field& shape, float level, float radius) {
    return unite(q(of, level + radius / 6), q(shape, level + radius / 6));
}
inline constexpr Parameter blended_object{"of", "", "The object."};
inline constexpr Parameter blended_phase{"phase", "", "The phase that grows."};
inline constexpr Parameter blended_shape{"shape", "", "The field to add."};
}  // namespace detail

/// Bₖ = {s < 0},  Bᵢ = Aᵢ − Bₖ,  and the vacuum A₀ − Bₖ: φ₀ = max(a₀, −s).
///
/// I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): each sum with φₖ is ≥ s − s; every other sum is ≥ the same sum of A.
struct SmoothUniteShape {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"smooth_unite_shape", "5.3",
                                   "s = smin(aₖ, f),  φₖ = s,  φᵢ = max(aᵢ, −s),  φ₀ = max(a₀, −s)",
                                   "Blends a shape into one phase, over the other phases."};
    Phased of{};
    Phase phase{1};
    Field shape{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothUniteShape::of, detail::blended_object);
        v(&SmoothUniteShape::phase, detail::blended_phase);
        v(&SmoothUniteShape::shape, detail::blended_shape);
        v(&SmoothUniteShape::radius, detail::blend);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        const auto s = detail::blended_with(a, phase.index, d.field(shape, p), radius);
        for_each_phase(a.present, [&](int i) { a.set(i, max(a[i], -s)); });
        a.set(phase.index, s);
        return a;
    }
    PhaseSet phases() const { return phasetree::phases(of) | PhaseSet::of(phase); }
    Bounds bounds(BoundsQuery& q, float level) const { return detail::blended_bounds(q, of, shape, level, radius); }
};

}  // namespace phasetree
