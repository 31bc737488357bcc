#pragma once

#include <utility>

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The profile is a trapezium in (ρ, z), ρ = |pxy|. The absolute distance is that to the nearer of the two edges that
/// bound the solid: the cap (a disk) and the slanted side (a segment). The sign is that of the larger of the two
/// half-space values.
struct CappedCone {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"capped_cone", "", "± min(distance to the caps, distance to the slanted side)",
                                   "A truncated cone about the z axis, centred at the origin; exact."};
    float radius_bottom = 1;
    float radius_top = 0;
    float height = 2;

    template <class V>
    static void parameters(V&& v) {
        v(&CappedCone::radius_bottom,
          Parameter{"radius_bottom", "m", "Radius at z = −height/2.", limits::non_negative});
        v(&CappedCone::radius_top, Parameter{"radius_top", "m", "Radius at z = height/2.", limits::non_negative});
        v(&CappedCone::height, Parameter{"height", "m", "Whole height.", limits::positive});
    }
    void prepare() const {
        if (radius_bottom == 0 && radius_top == 0) throw ModelError("capped_cone: both radii are zero");
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T zero(0.f);
        const float h = height * 0.5f;
        const T rho = length(p.x, p.y);
        // The squared distance to the nearer cap, a disk with its own radius.
        const T cap_radius = select(less(p.z, zero), T(radius_bottom), T(radius_top));
        const T cap_out = max(rho - cap_radius, zero);
        const T cap_z = abs(p.z) - h;
        const T to_cap = cap_out * cap_out + cap_z * cap_z;
        // The squared distance to the side, the segment from (radius_top, h) to (radius_bottom, −h).
        const float ex = radius_bottom - radius_top, ez = -height;
        const float inverse = 1.f / (ex * ex + ez * ez);
        const T qx = rho - radius_top, qz = p.z - h;
        const T s = clamp((qx * ex + qz * ez) * inverse, zero, T(1.f));
        const T sx = qx - s * ex, sz = qz - s * ez;
        const T to_side = sx * sx + sz * sz;
        // A point is inside if and only if it is within the slab and on the axis side of the slanted line.
        const T side = max(cap_z, qx * -ez + qz * ex);
        const T d = sqrt(min(to_cap, to_side));
        // Where the interior of the side, and not one of its ends, is nearest, the distance is linear in ρ and z.
        return also_known_as(select(less(side, zero), -d, d), [&](const auto& certainly) {
            const bool is_side = certainly(less(cap_z, zero)) && certainly(less(to_side, to_cap)) &&
                                 certainly(less(zero, s)) && certainly(less(s, T(1.f)));
            return std::pair(is_side, (qx * -ez + qz * ex) * std::sqrt(inverse));
        });
    }
    double support(const glm::dvec3& d, float level) const {
        const double rho = detail::disk_support(d), up = d.z * 0.5 * static_cast<double>(height);
        return std::max(rho * static_cast<double>(radius_bottom) - up, rho * static_cast<double>(radius_top) + up) +
               glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        const float r = std::max(radius_bottom, radius_top) + level;
        return Bounds::centred({r, r, height * 0.5f + level});
    }
};

}  // namespace phasetree
