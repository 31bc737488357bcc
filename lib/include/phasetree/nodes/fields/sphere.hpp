#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Sphere {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"sphere", "", "|p| − r", "A ball about the origin; exact."};
    float radius = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Sphere::radius, Parameter{"radius", "m", "Radius.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return length(p) - radius;
    }
    double rolling_radius(const glm::dvec3&, double) const { return static_cast<double>(radius); }
    double support(const glm::dvec3& d, float level) const {
        return glm::length(d) * static_cast<double>(radius + level);
    }
    Bounds bounds(BoundsQuery&, float level) const { return Bounds::centred(glm::vec3(radius + level)); }
};

}  // namespace phasetree
