#pragma once

#include "phasetree/nodes/phased/smooth_unite_shape.hpp"

namespace phasetree {

/// Bₖ = {s < 0} − ∪ over j ≠ k of Aⱼ,  Bᵢ = Aᵢ,  and the vacuum A₀ − {s < 0}, as with the union over the other phases.
///
/// I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): φₖ + aᵢ ≥ −min aⱼ + aᵢ ≥ 0,  φₖ + φ₀ ≥ s − s,  aᵢ + φ₀ ≥ aᵢ + a₀.
struct SmoothUniteShapeBelow {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"smooth_unite_shape_below", "5.3",
                                   "s = smin(aₖ, f),  φₖ = max(s, −min over j ≠ k of aⱼ),  φ₀ = max(a₀, −s)",
                                   "Blends a shape into one phase, below the other phases."};
    Phased of{};
    Phase phase{1};
    Field shape{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothUniteShapeBelow::of, detail::blended_object);
        v(&SmoothUniteShapeBelow::phase, detail::blended_phase);
        v(&SmoothUniteShapeBelow::shape, detail::blended_shape);
        v(&SmoothUniteShapeBelow::radius, detail::blend);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        const auto s = detail::blended_with(a, phase.index, d.field(shape, p), radius);
        const auto others = detail::minimum(a, a.materials() & ~PhaseSet::of(phase).bits);
        a.set(phase.index, others ? max(s, -*others) : s);
        if (a.has(0)) a.set(0, max(a[0], -s));
        return a;
    }
    PhaseSet phases() const { return phasetree::phases(of) | PhaseSet::of(phase); }
    Bounds bounds(BoundsQuery& q, float level) const { return detail::blended_bounds(q, of, shape, level, radius); }
};

}  // namespace phasetree
