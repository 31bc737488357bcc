#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The profile in (ρ, z), ρ = |pxy|, is a rectangle that does not touch the axis. Revolving it preserves distances,
/// because the nearest point is in the half-plane of the point itself.
struct Tube {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "tube", "", "q = (||pxy| − (R + r)/2| − (R − r)/2, |pz| − h/2);  |max(q, 0)| + min(max(qx, qy), 0)",
        "A hollow cylinder about the z axis, open at both ends; exact."};
    float radius = 1;
    float inner_radius = 0.75f;
    float height = 2;

    template <class V>
    static void parameters(V&& v) {
        v(&Tube::radius, Parameter{"radius", "m", "Outer radius.", limits::positive});
        v(&Tube::inner_radius,
          Parameter{"inner_radius", "m", "Radius of the hole, less than the outer one.", limits::positive});
        v(&Tube::height, Parameter{"height", "m", "Whole height.", limits::positive});
    }
    void prepare() const {
        if (inner_radius >= radius) throw ModelError("tube: the inner radius must be less than the outer one");
        detail::require_usable(info.name, {radius, inner_radius, height});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const float middle = (radius + inner_radius) * 0.5f, half_wall = (radius - inner_radius) * 0.5f;
        return corner(abs(length(p.x, p.y) - middle) - half_wall, abs(p.z) - height * 0.5f);
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::disk_support(d) * static_cast<double>(radius) +
               std::abs(d.z) * 0.5 * static_cast<double>(height) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        if ((radius - inner_radius) * 0.5f + level < 0) return {};
        return Bounds::centred(glm::vec3{radius, radius, height * 0.5f} + level);
    }
};

}  // namespace phasetree
