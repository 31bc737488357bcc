// Shared code of the triply periodic sheets. g is a trigonometric polynomial of k·p, k = 2π/period, whose zero set is
// near a minimal surface. For each of them sup‖∇g‖ = √3 in units of k, as proven at each node. So
//     f = |g(k p)|/(√3 k) − t/2
// is 1-Lipschitz. The wall is nowhere thinner than t, because f needs a distance of at least t/2 to change by t/2.
#pragma once

#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree::detail {

/// Sine and cosine of the three angles k·p. Whole periods are subtracted first, so p can be any point.
template <class T>
struct Angles {
    SineCosine<T> x, y, z;
};
template <class T>
Angles<T> angles(const Vec3<T>& p, float period) {
    const auto of = [inverse = 1.f / period](const T& v) {
        const T turns = v * inverse;
        return sine_cosine((turns - floor(turns)) * 6.2831853f);
    };
    return {of(p.x), of(p.y), of(p.z)};
}

/// The factor 1/(√3 k) that makes g 1-Lipschitz.
inline float sheet_scale(float period) {
    return period * 0.09188814f;
}

inline constexpr Parameter sheet_period{"period", "m", "Edge length of the unit cell.", limits::positive};
inline constexpr Parameter sheet_thickness{"thickness", "m", "Minimum thickness of the wall.", limits::positive};

/// Throw ModelError if the sizes are unusable, or if the wall fills all of space. `most` is the maximum of |g|.
inline void check_sheet(std::string_view node, float period, float thickness, float most) {
    require_usable(node, {period, thickness});
    if (thickness * 0.5f >= most * sheet_scale(period))
        throw ModelError(std::string(node) + ": the wall is so thick that it fills all of space");
}
inline Bounds sheet_bounds(float thickness, float level) {
    return thickness * 0.5f + level < 0 ? Bounds() : Bounds::everything();
}

}  // namespace phasetree::detail
