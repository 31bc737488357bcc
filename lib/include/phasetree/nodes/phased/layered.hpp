#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

struct Layered {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"layered", "4.5", "φₖ = max(−a₀ − t, a₀),  φ₀ = a₀ + t",
                                   "Embeds an object in a layer of another phase."};
    Phased of{};
    Phase phase{1};
    float thickness = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&Layered::of, Parameter{"of", "", "The object."});
        v(&Layered::phase, Parameter{"phase", "", "The phase of the layer."});
        v(&Layered::thickness, Parameter{"thickness", "m", "Thickness of the layer.", limits::positive});
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        if (!a.has(0)) return a;  // no vacuum: the object fills space, so there is nothing to coat
        const auto outside = a[0];
        const auto layer = max(-outside - thickness, outside);
        a.set(phase.index, a.has(phase.index) ? min(a[phase.index], layer) : layer);
        a.set(0, outside + thickness);
        return a;
    }
    PhaseSet phases() const {
        const PhaseSet there = phasetree::phases(of);
        return there.contains(vacuum) ? there | PhaseSet::of(phase) : there;
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level + thickness); }
};

}  // namespace phasetree
