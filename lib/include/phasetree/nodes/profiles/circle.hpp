#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Circle {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"circle", "", "|pxy| − r",
                                   "A disk about the origin, for extruding and revolving; the same at every z, exact."};
    float radius = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Circle::radius, Parameter{"radius", "m", "Radius.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return length(p.x, p.y) - radius;
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::section_support(d, detail::disk_support(d) * static_cast<double>(radius + level));
    }
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred({radius + level, radius + level, Bounds::infinity});
    }
};

}  // namespace phasetree
