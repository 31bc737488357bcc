#pragma once

#include "phasetree/nodes/fields/fold.hpp"

namespace phasetree {

struct Union {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"union", "", "min fᵢ", "The points that are inside any field."};
    std::vector<Field> of{};

    template <class V>
    static void parameters(V&& v) {
        v(&Union::of, detail::children);
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return detail::fold(d, of, p, [](const auto& a, const auto& b) { return min(a, b); });
    }
    Bounds bounds(BoundsQuery& q, float level) const { return detail::united(q, of, level); }
};

}  // namespace phasetree
