#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// Aₖ ∪ S − ∪ over j ≠ k of Aⱼ, which is {S filled with k} ∪₋ A. The paper (Galin et al., Section 5.1) prints these
/// sets correctly, but under the wrong name: as the phase-specific intersection.
///
/// I2 (φᵢ + φⱼ ≥ 0 for i ≠ j): φₖ + aᵢ ≥ −min aⱼ + aᵢ ≥ 0, and φₖ + φ₀ ≥ min(aₖ + a₀, f − f).
struct UniteShapeBelow {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"unite_shape_below", "5.1",
                                   "φₖ = max(min(aₖ, f), −min over j ≠ k of aⱼ),  φ₀ = max(a₀, −f)",
                                   "Adds a shape to one phase, below the other phases."};
    Phased of{};
    Phase phase{1};
    Field shape{};

    template <class V>
    static void parameters(V&& v) {
        v(&UniteShapeBelow::of, Parameter{"of", "", "The object."});
        v(&UniteShapeBelow::phase, Parameter{"phase", "", "The phase that grows."});
        v(&UniteShapeBelow::shape, Parameter{"shape", "", "The field to add."});
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        const auto f = d.field(shape, p);
        const auto grown = a.has(phase.index) ? min(a[phase.index], f) : f;
        const auto others = detail::minimum(a, a.materials() & ~PhaseSet::of(phase).bits);
        a.set(phase.index, others ? max(grown, -*others) : grown);
        if (a.has(0)) a.set(0, max(a[0], -f));
        return a;
    }
    PhaseSet phases() const { return phasetree::phases(of) | PhaseSet::of(phase); }
    Bounds bounds(BoundsQuery& q, float level) const { return unite(q(of, level), q(shape, level)); }
};

}  // namespace phasetree
