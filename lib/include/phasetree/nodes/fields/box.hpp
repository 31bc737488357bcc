#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The distance to a box around the origin with half extents h. Shared by several kinds of boxes.
template <class T>
T box_distance(const Vec3<T>& p, const glm::vec3& h) {
    return corner(abs(p.x) - h.x, abs(p.y) - h.y, abs(p.z) - h.z);
}

struct Box {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"box", "", "q = |p| − s/2;  |max(q, 0)| + min(max(qx, qy, qz), 0)",
                                   "A box about the origin; exact."};
    glm::vec3 size{1};

    template <class V>
    static void parameters(V&& v) {
        v(&Box::size, Parameter{"size", "m", "Edge lengths along x, y and z.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return box_distance(p, size * 0.5f);
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::box_support(d, glm::dvec3(size) * 0.5) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const { return Bounds::centred(size * 0.5f + level); }
};

}  // namespace phasetree
