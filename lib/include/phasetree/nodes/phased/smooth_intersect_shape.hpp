#pragma once

#include "phasetree/nodes/phased/smooth_cut.hpp"

namespace phasetree {

struct SmoothIntersectShape {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"smooth_intersect_shape", "5.3",
                                   "s = −smin(−aₖ, −f),  φₖ = s,  φ₀ = min(a₀, max(aₖ, −s, −f − r))",
                                   "Keeps only the part of one phase inside a shape, and rounds the new edges."};
    Phased of{};
    Phase phase{1};
    Field shape{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothIntersectShape::of, detail::smooth_cut_object);
        v(&SmoothIntersectShape::phase, detail::smooth_cut_phase);
        v(&SmoothIntersectShape::shape, Parameter{"shape", "", "The field to keep within."});
        v(&SmoothIntersectShape::radius, detail::blend);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto a = d.phases(of, p);
        return a.has(phase.index) ? detail::smooth_cut(a, phase.index, d.field(shape, p), radius) : a;
    }
    PhaseSet phases() const { return detail::smooth_cut_phases(of, phase); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
