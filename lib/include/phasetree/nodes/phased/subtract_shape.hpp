#pragma once

#include "phasetree/nodes/phased/shape_cut.hpp"

namespace phasetree {

struct SubtractShape {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"subtract_shape", "5.1",
                                   "φₖ = max(aₖ, −f),  φ₀ = min(a₀, f) if all phases are cut, "
                                   "else min(a₀, min over the cut k of max(aₖ, f))",
                                   "Cuts a shape out of all phases of an object, or out of only some of them."};
    Phased of{};
    Field shape{};
    PhaseSet phases_cut{};

    template <class V>
    static void parameters(V&& v) {
        v(&SubtractShape::of, detail::cut_object);
        v(&SubtractShape::shape, Parameter{"shape", "", "The field to cut away."});
        v(&SubtractShape::phases_cut, detail::cut_phases);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto a = d.phases(of, p);
        return detail::cut(a, -d.field(shape, p), phases_cut);
    }
    PhaseSet phases() const { return detail::phases_after_cut(phasetree::phases(of), phases_cut); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
