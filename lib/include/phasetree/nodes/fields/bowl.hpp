#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The wall is the set of points within t/2 of the part of a sphere's surface with z ≤ c. In (ρ, z), ρ = |pxy|, that
/// part is an arc up to the rim (w, c), w = √(R² − c²). The nearest point of the whole circle, R p/|p|, is on the arc
/// where R pz ≤ c |p|; elsewhere the rim is nearest.
struct Bowl {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"bowl", "", "(R pz ≤ c |p| ? ||p| − R| : |(|pxy| − w, pz − c)|) − t/2",
                                   "A hollow ball about the origin, cut open at a height, with a rounded rim; exact "
                                   "unless the rim closes the opening."};
    float radius = 1;
    float cut = 0;
    float thickness = 0.1f;
    float rim = 1;  ///< w, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Bowl::radius, Parameter{"radius", "m", "Radius of the middle of the wall.", limits::positive});
        v(&Bowl::cut, Parameter{"cut", "m", "Height z of the rim; 0 leaves a hemisphere.", limits::any, true});
        v(&Bowl::thickness,
          Parameter{"thickness", "m", "Thickness of the wall, less than twice the radius.", limits::positive});
    }
    void prepare() {
        detail::require_usable(info.name, {radius, thickness});
        if (!(std::abs(cut) < radius)) throw ModelError("bowl: \"cut\" must be between −\"radius\" and \"radius\"");
        if (!(thickness < 2 * radius)) throw ModelError("bowl: the wall fills the ball");
        rim = std::sqrt((radius - cut) * (radius + cut));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T from_centre = length(p);
        const T to_rim = length(length(p.x, p.y) - rim, p.z - cut);
        return select(less(from_centre * cut, p.z * radius), to_rim, abs(from_centre - radius)) - thickness * 0.5f;
    }
    /// The support of the ball that contains the wall.
    double support(const glm::dvec3& d, float level) const {
        return glm::length(d) * static_cast<double>(radius + 0.5f * thickness + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        if (thickness * 0.5f + level < 0) return {};
        const float side = cut < 0 ? rim : radius;
        return Bounds{{-side, -side, -radius}, {side, side, cut}}.inflated(thickness * 0.5f + level);
    }
};

}  // namespace phasetree
