#pragma once

#include "phasetree/nodes/fields/fold.hpp"

namespace phasetree {

struct Difference {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"difference", "", "max(f, −min gᵢ)", "Subtracts fields from a field."};
    Field from{};
    std::vector<Field> subtract{};

    template <class V>
    static void parameters(V&& v) {
        v(&Difference::from, Parameter{"from", "", "The field to cut."});
        v(&Difference::subtract, Parameter{"subtract", "", "The fields to cut away, at least one."});
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        const auto kept = d.field(from, p);
        return max(kept, -detail::fold(d, subtract, p, [](const auto& a, const auto& b) { return min(a, b); }));
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(from, level); }
};

}  // namespace phasetree
