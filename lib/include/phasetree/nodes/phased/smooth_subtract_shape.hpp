#pragma once

#include "phasetree/nodes/phased/smooth_cut.hpp"

namespace phasetree {

struct SmoothSubtractShape {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"smooth_subtract_shape", "5.3",
                                   "s = −smin(−aₖ, f),  φₖ = s,  φ₀ = min(a₀, max(aₖ, −s, f − r))",
                                   "Cuts a shape away from one phase, and rounds the new edges."};
    Phased of{};
    Phase phase{1};
    Field shape{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothSubtractShape::of, detail::smooth_cut_object);
        v(&SmoothSubtractShape::phase, detail::smooth_cut_phase);
        v(&SmoothSubtractShape::shape, Parameter{"shape", "", "The field to cut away."});
        v(&SmoothSubtractShape::radius, detail::blend);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto a = d.phases(of, p);
        return a.has(phase.index) ? detail::smooth_cut(a, phase.index, -d.field(shape, p), radius) : a;
    }
    PhaseSet phases() const { return detail::smooth_cut_phases(of, phase); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
