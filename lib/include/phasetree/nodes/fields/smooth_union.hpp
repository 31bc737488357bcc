#pragma once

#include "phasetree/nodes/fields/fold.hpp"

namespace phasetree {

struct SmoothUnion {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"smooth_union", "9.3", "smin(a, b) = min(a, b) − r/6 · max(1 − |b − a|/r, 0)³",
                                   "Union with filleted seams; applied pairwise, from the first field to the last."};
    std::vector<Field> of{};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SmoothUnion::of, detail::children);
        v(&SmoothUnion::radius, detail::blend);
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return detail::fold(d, of, p, [r = radius](const auto& a, const auto& b) { return smooth_min(a, b, r); });
    }
    /// Each step lowers the minimum by at most r/6.
    Bounds bounds(BoundsQuery& q, float level) const {
        return detail::united(q, of, level + radius / 6 * static_cast<float>(of.size() - 1));
    }
};

}  // namespace phasetree
