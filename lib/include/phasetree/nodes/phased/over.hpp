#pragma once

#include "phasetree/nodes/phased/under.hpp"

namespace phasetree {

struct Over {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"over", "4.3", "A ∪₊ B = B ∪₋ A;  A ∪₊ (B ∪₊ (C ∪₊ …))",
                                   "Combines objects; where they overlap, earlier ones replace later ones. Applied "
                                   "pairwise, from the last object to the first."};
    std::vector<Phased> of{};

    template <class V>
    static void parameters(V&& v) {
        v(&Over::of, detail::objects);
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        Phases<typename D::Scalar> result = d.phases(of.back(), p);
        for (std::size_t i = of.size() - 1; i-- > 0;) result = detail::under(result, d.phases(of[i], p));
        return result;
    }
    PhaseSet phases() const { return detail::united_phases(of); }
    Bounds bounds(BoundsQuery& q, float level) const {
        Bounds b;
        for (const Phased& child : of) b = unite(b, q(child, level));
        return b;
    }
};

}  // namespace phasetree
