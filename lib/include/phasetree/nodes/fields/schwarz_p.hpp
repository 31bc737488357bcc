#pragma once

#include "phasetree/nodes/fields/triply_periodic.hpp"

namespace phasetree {

/// g = cos x + cos y + cos z.  ‖∇g‖² = sin²x + sin²y + sin²z ≤ 3, reached where all three are π/2; |g| ≤ 3.
struct SchwarzP {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "schwarz_p", "", "|cos x + cos y + cos z|/(√3 k) − t/2,  (x, y, z) = k p,  k = 2π/period",
        "A wall along Schwarz' primitive surface, repeated endlessly along all axes; a lower bound."};
    float period = 1;
    float thickness = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SchwarzP::period, detail::sheet_period);
        v(&SchwarzP::thickness, detail::sheet_thickness);
    }
    void prepare() const { detail::check_sheet(info.name, period, thickness, 3.f); }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const auto [x, y, z] = detail::angles(p, period);
        return abs(x.cosine + y.cosine + z.cosine) * detail::sheet_scale(period) - thickness * 0.5f;
    }
    Bounds bounds(BoundsQuery&, float level) const { return detail::sheet_bounds(thickness, level); }
};

}  // namespace phasetree
