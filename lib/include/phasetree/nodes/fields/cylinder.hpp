#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Cylinder {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"cylinder", "", "q = (|pxy| − r, |pz| − h/2);  |max(q, 0)| + min(max(qx, qy), 0)",
                                   "A cylinder about the z axis, centred at the origin; exact."};
    float radius = 1;
    float height = 2;

    template <class V>
    static void parameters(V&& v) {
        v(&Cylinder::radius, Parameter{"radius", "m", "Radius.", limits::positive});
        v(&Cylinder::height, Parameter{"height", "m", "Whole height.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return corner(length(p.x, p.y) - radius, abs(p.z) - height * 0.5f);
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::disk_support(d) * static_cast<double>(radius) +
               std::abs(d.z) * 0.5 * static_cast<double>(height) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred({radius + level, radius + level, height * 0.5f + level});
    }
};

}  // namespace phasetree
