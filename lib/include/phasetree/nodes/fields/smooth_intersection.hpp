#pragma once

#include "phasetree/nodes/fields/fold.hpp"

namespace phasetree {

struct SmoothIntersection {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "smooth_intersection", "9.3", "−smin(−a, −b)",
        "Intersection with rounded edges; applied pairwise, from the first field to the last."};
    std::vector<Field> of{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothIntersection::of, detail::children);
        v(&SmoothIntersection::radius, detail::blend);
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return detail::fold(d, of, p, [r = radius](const auto& a, const auto& b) { return smooth_max(a, b, r); });
    }
    Bounds bounds(BoundsQuery& q, float level) const { return detail::intersected(q, of, level); }
};

}  // namespace phasetree
