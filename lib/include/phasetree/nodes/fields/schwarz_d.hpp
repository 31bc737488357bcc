#pragma once

#include "phasetree/nodes/fields/triply_periodic.hpp"

namespace phasetree {

///     g = sin x sin y sin z + sin x cos y cos z + cos x sin y cos z + cos x cos y sin z
///       = sin x cos A + cos x sin B,  A = y − z, B = y + z.
///
/// With s = |sin x|, c = |cos x|, a = |cos A|, b = |sin B|: (∂g/∂x)² = (cos x cos A − sin x sin B)² ≤ (ca + sb)², and
/// (∂g/∂y)² + (∂g/∂z)² = 2(sin²x sin²A + cos²x cos²B) = 2 − 2s²a² − 2c²b². From 2(ca)(sb) ≤ s²a² + c²b² it follows that
/// (ca + sb)² ≤ a² + b². So ‖∇g‖² ≤ 2 + (a² − b²)(1 − 2s²) ≤ 3, because a² + b² − 2s²a² − 2c²b² is that product. √3 is
/// reached at the origin. And |g| ≤ |(cos A, sin B)| ≤ √2.
struct SchwarzD {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "schwarz_d", "",
        "|sin x cos(y − z) + cos x sin(y + z)|/(√3 k) − t/2,  (x, y, z) = k p,  k = "
        "2π/period",
        "A wall along Schwarz' diamond surface, repeated endlessly along all axes; a lower bound."};
    float period = 1;
    float thickness = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&SchwarzD::period, detail::sheet_period);
        v(&SchwarzD::thickness, detail::sheet_thickness);
    }
    void prepare() const { detail::check_sheet(info.name, period, thickness, 1.4142135f); }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const auto [x, y, z] = detail::angles(p, period);
        const T g =
            x.sine * (y.cosine * z.cosine + y.sine * z.sine) + x.cosine * (y.sine * z.cosine + y.cosine * z.sine);
        return abs(g) * detail::sheet_scale(period) - thickness * 0.5f;
    }
    Bounds bounds(BoundsQuery&, float level) const { return detail::sheet_bounds(thickness, level); }
};

}  // namespace phasetree
