#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Capsule {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"capsule", "", "|p − nearest point of the segment| − r",
                                   "All points within r of a segment; exact."};
    glm::vec3 from{0, 0, -1};
    glm::vec3 to{0, 0, 1};
    float radius = 0.5f;

    template <class V>
    static void parameters(V&& v) {
        v(&Capsule::from, Parameter{"from", "m", "One end of the segment."});
        v(&Capsule::to, Parameter{"to", "m", "The other end."});
        v(&Capsule::radius, Parameter{"radius", "m", "Radius.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const glm::vec3 axis = to - from;
        const float squared = glm::dot(axis, axis);
        return sqrt(squared_distance_to_segment(p - from, axis, squared > 0 ? 1.f / squared : 0.f)) - radius;
    }
    double rolling_radius(const glm::dvec3&, double) const { return static_cast<double>(radius); }
    double support(const glm::dvec3& d, float level) const {
        return detail::hull_support(d, {glm::dvec3(from), glm::dvec3(to)}) +
               glm::length(d) * static_cast<double>(radius + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        if (radius + level < 0) return {};
        return Bounds{glm::min(from, to), glm::max(from, to)}.inflated(radius + level);
    }
};

}  // namespace phasetree
