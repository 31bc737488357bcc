#pragma once

#include "phasetree/nodes/fields/fold.hpp"

namespace phasetree {

struct Intersection {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"intersection", "", "max fᵢ", "The points that are inside all fields."};
    std::vector<Field> of{};

    template <class V>
    static void parameters(V&& v) {
        v(&Intersection::of, detail::children);
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return detail::fold(d, of, p, [](const auto& a, const auto& b) { return max(a, b); });
    }
    Bounds bounds(BoundsQuery& q, float level) const { return detail::intersected(q, of, level); }
};

}  // namespace phasetree
