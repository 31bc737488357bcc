#pragma once

#include <glm/trigonometric.hpp>

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// All points within r of an arc of radius R. Let φ be half of the arc's angle, and fold y to |y|. Consider a point at
/// distance ρ from the axis, in the direction θ. It is within the arc's angle if sin φ · x − cos φ · |y| ≥ 0; the
/// left-hand side equals ρ sin(φ − θ). Its nearest point of the arc is then at the same θ, as in the equation of a
/// torus. Any other point is nearest to the arc's end R(cos φ, sin φ, 0), because the distance to a point of a circle
/// grows with the angle between the two.
struct CappedTorus {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"capped_torus", "", "|p − nearest point of the arc| − r",
                                   "Part of a ring about the z axis, with round ends, centred on the x axis; exact if "
                                   "the tube's radius is at most the ring's."};
    float major = 1;
    float minor = 0.25f;
    float angle = 180;
    float cosine = 0;  ///< of half the angle, derived
    float sine = 1;    ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&CappedTorus::major, Parameter{"major", "m", "Radius of the arc.", limits::positive});
        v(&CappedTorus::minor, Parameter{"minor", "m", "Radius of the tube.", limits::positive});
        v(&CappedTorus::angle,
          Parameter{"angle", "degrees", "Angle of the whole arc.", Limits{.low = 0, .high = 360, .low_open = true}});
    }
    void prepare() {
        detail::require_usable(info.name, {major, minor});
        cosine = std::cos(glm::radians(angle) * 0.5f);
        sine = std::max(std::sin(glm::radians(angle) * 0.5f), 0.f);
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T y = abs(p.y);
        const T ring = length(p.x, y) - major;
        const T to_arc = ring * ring + p.z * p.z;
        const T ex = p.x - major * cosine, ey = y - major * sine;
        const T to_end = ex * ex + ey * ey + p.z * p.z;
        return sqrt(select(less(p.x * sine - y * cosine, T(0.f)), to_end, to_arc)) - minor;
    }
    /// The support of the complete torus.
    double support(const glm::dvec3& d, float level) const {
        return detail::disk_support(d) * static_cast<double>(major) +
               glm::length(d) * static_cast<double>(minor + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        const float r = minor + level;
        if (r < 0) return {};
        const float side = cosine > 0 ? major * sine : major;
        return Bounds{{major * cosine, -side, 0}, {major, side, 0}}.inflated(r);
    }
};

}  // namespace phasetree
