#pragma once

#include "phasetree/nodes/phased/shape_cut.hpp"

namespace phasetree {

/// The phase-specific form keeps Aₖ ∩ S. What the paper (Galin et al., Section 5.1) prints under this name is the union
/// of Aₖ with S below the other phases: unite_shape_below.
struct IntersectShape {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"intersect_shape", "5.1",
                                   "φₖ = max(aₖ, f),  φ₀ = min(a₀, −f) if all phases are cut, "
                                   "else min(a₀, min over the cut k of max(aₖ, −f))",
                                   "Cuts all phases of an object, or only some of them, to the inside of a shape."};
    Phased of{};
    Field shape{};
    PhaseSet phases_cut{};

    template <class V>
    static void parameters(V&& v) {
        v(&IntersectShape::of, detail::cut_object);
        v(&IntersectShape::shape, Parameter{"shape", "", "The field to keep within."});
        v(&IntersectShape::phases_cut, detail::cut_phases);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto a = d.phases(of, p);
        return detail::cut(a, d.field(shape, p), phases_cut);
    }
    PhaseSet phases() const { return detail::phases_after_cut(phasetree::phases(of), phases_cut); }
    Bounds bounds(BoundsQuery& q, float level) const {
        const bool all = phases_cut.empty() || (phasetree::phases(of).bits & ~std::uint64_t{1} & ~phases_cut.bits) == 0;
        return all ? q.cut([&] { return intersect(q(of, level), q(shape, level)); }) : q(of, level);
    }
};

}  // namespace phasetree
