#pragma once

#include "phasetree/nodes/fields/triply_periodic.hpp"

namespace phasetree {

/// g = sin x cos y + sin y cos z + sin z cos x.  ∂g/∂x = cos x cos y − sin z sin x, so (∂g/∂x)² ≤ (cos²x + sin²x)(cos²y
/// + sin²z) by the Cauchy–Schwarz inequality. Likewise (∂g/∂y)² ≤ cos²z + sin²x and (∂g/∂z)² ≤ cos²x + sin²y. These sum
/// to 3, so ‖∇g‖ ≤ √3, which is reached at the origin. And |g| ≤ 3/2, because sin a cos b ≤ (sin²a + cos²b)/2.
struct Gyroid {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"gyroid", "",
                                   "|sin x cos y + sin y cos z + sin z cos x|/(√3 k) − t/2,  (x, y, z) = k p,  k = "
                                   "2π/period",
                                   "A wall along Schoen's gyroid, repeated endlessly along all axes; a lower bound."};
    float period = 1;
    float thickness = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&Gyroid::period, detail::sheet_period);
        v(&Gyroid::thickness, detail::sheet_thickness);
    }
    void prepare() const { detail::check_sheet(info.name, period, thickness, 1.5f); }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const auto [x, y, z] = detail::angles(p, period);
        const T g = x.sine * y.cosine + y.sine * z.cosine + z.sine * x.cosine;
        return abs(g) * detail::sheet_scale(period) - thickness * 0.5f;
    }
    Bounds bounds(BoundsQuery&, float level) const { return detail::sheet_bounds(thickness, level); }
};

}  // namespace phasetree
