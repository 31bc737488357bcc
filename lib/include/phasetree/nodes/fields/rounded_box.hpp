#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/box.hpp"

namespace phasetree {

struct RoundedBox {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"rounded_box", "", "box(s − 2r) − r",
                                   "A box with rounded edges and corners, without a change of size; exact."};
    glm::vec3 size{1};
    float radius = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&RoundedBox::size,
          Parameter{"size", "m", "Edge lengths along x, y and z, rounding included.", limits::positive});
        v(&RoundedBox::radius,
          Parameter{"radius", "m", "Radius of the edges, at most half the shortest edge.", limits::non_negative});
    }
    void prepare() const {
        if (2 * radius > std::min({size.x, size.y, size.z}))
            throw ModelError("rounded_box: the radius is more than half the shortest edge");
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return box_distance(p, size * 0.5f - radius) - radius;
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::box_support(d, glm::dvec3(size) * 0.5 - static_cast<double>(radius)) +
               glm::length(d) * static_cast<double>(radius + level);
    }
    Bounds bounds(BoundsQuery&, float level) const { return Bounds::centred(size * 0.5f + level); }
};

}  // namespace phasetree
