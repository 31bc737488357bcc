#pragma once

#include "phasetree/nodes/fields/fold.hpp"

namespace phasetree {

struct SmoothDifference {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"smooth_difference", "9.3", "−smin(−f, smin gᵢ)",
                                   "Subtracts fields from a field and rounds the new edges."};
    Field from{};
    std::vector<Field> subtract{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothDifference::from, Parameter{"from", "", "The field to cut."});
        v(&SmoothDifference::subtract, Parameter{"subtract", "", "The fields to cut away, at least one."});
        v(&SmoothDifference::radius, detail::blend);
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        const auto kept = d.field(from, p);
        return smooth_max(
            kept,
            -detail::fold(d, subtract, p, [r = radius](const auto& a, const auto& b) { return smooth_min(a, b, r); }),
            radius);
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(from, level); }
};

}  // namespace phasetree
