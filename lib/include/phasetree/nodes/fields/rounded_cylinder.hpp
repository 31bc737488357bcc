#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

struct RoundedCylinder {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"rounded_cylinder", "", "cylinder(r − e, h − 2e) − e",
                                   "A cylinder with rounded rims, without a change of size; exact."};
    float radius = 1;
    float height = 2;
    float edge = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&RoundedCylinder::radius, Parameter{"radius", "m", "Radius, rounding included.", limits::positive});
        v(&RoundedCylinder::height, Parameter{"height", "m", "Whole height, rounding included.", limits::positive});
        v(&RoundedCylinder::edge,
          Parameter{"edge", "m", "Radius of the rims, at most the radius and half the height.", limits::non_negative});
    }
    void prepare() const {
        if (edge > radius || 2 * edge > height)
            throw ModelError("rounded_cylinder: the edge's radius is more than the radius or half the height");
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return corner(length(p.x, p.y) - (radius - edge), abs(p.z) - (height * 0.5f - edge)) - edge;
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::disk_support(d) * static_cast<double>(radius) +
               std::abs(d.z) * 0.5 * static_cast<double>(height) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred(glm::vec3{radius, radius, height * 0.5f} + level);
    }
};

}  // namespace phasetree
