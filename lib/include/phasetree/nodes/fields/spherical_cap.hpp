#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The part of the ball above z = c. Its boundary in (ρ, z), ρ = |pxy|, is the disk ρ ≤ w = √(r² − c²) at z = c and the
/// arc above it. The nearest point of the whole circle, r p/|p|, is on that arc where r pz ≥ c|p|. Elsewhere the arc's
/// nearest point is the rim, which also belongs to the disk, so the disk alone suffices.
struct SphericalCap {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"spherical_cap", "", "± min(distance to the disk, ||p| − r| where r pz ≥ c |p|)",
                                   "The part of a ball about the origin above the plane z = c; exact."};
    float radius = 1;
    float cut = 0;
    float rim = 1;  ///< radius of the disk, derived

    template <class V>
    static void parameters(V&& v) {
        v(&SphericalCap::radius, Parameter{"radius", "m", "Radius of the ball.", limits::positive});
        v(&SphericalCap::cut,
          Parameter{"cut", "m", "Height z of the plane; 0 leaves a hemisphere.", limits::any, true});
    }
    void prepare() {
        detail::require_usable(info.name, {radius});
        if (!(std::abs(cut) < radius)) throw ModelError("spherical_cap: the plane does not cut the ball");
        rim = std::sqrt((radius - cut) * (radius + cut));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T rho = length(p.x, p.y), from_centre = length(p);
        const T to_ball = from_centre - radius, below = cut - p.z;
        const T to_disk = length(max(rho - rim, T(0.f)), below);
        // Outside the ball only the arc is used, because near the rim the arc and the disk tie within rounding.
        const T to_arc = select(less(T(0.f), to_ball), to_ball, min(to_disk, -to_ball));
        const T d = select(less(p.z * radius, from_centre * cut), to_disk, to_arc);
        return select(less(max(to_ball, below), T(0.f)), -d, d);
    }
    /// The support of the ball that contains the cap.
    double support(const glm::dvec3& d, float level) const {
        return glm::length(d) * static_cast<double>(radius + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        const float side = cut > 0 ? rim : radius;
        return Bounds{{-side, -side, cut}, {side, side, radius}}.inflated(level);
    }
};

}  // namespace phasetree
