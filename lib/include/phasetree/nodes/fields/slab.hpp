#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Slab {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"slab", "", "|p·n − d| − t/2", "What is between two parallel planes; exact."};
    glm::vec3 normal{0, 0, 1};
    float offset = 0;
    float thickness = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Slab::normal, Parameter{"normal", "", "Direction across the slab; any length but zero.", limits::any, true});
        v(&Slab::offset,
          Parameter{"offset", "m", "Distance of its middle from the origin along the normal.", limits::any, true});
        v(&Slab::thickness, Parameter{"thickness", "m", "Distance of the two planes.", limits::positive});
    }
    void prepare() {
        const glm::dvec3 n(normal);
        if (!(glm::length(n) > 0)) throw ModelError("slab: the normal has no direction");
        // One of unit length stays as it is, so that a slab that is written and read again is the same.
        if (std::abs(glm::length(n) - 1) > 1e-6) normal = glm::vec3(glm::normalize(n));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return abs(dot(p, normal) - offset) - thickness * 0.5f;
    }
    /// The box is infinite, but for the two sides that an axis-parallel slab bounds.
    Bounds bounds(BoundsQuery&, float level) const {
        Bounds b = Bounds::everything();
        const float half = thickness * 0.5f + level;
        if (half < 0) return {};
        for (int i = 0; i < 3; ++i) {
            if (std::abs(normal[i]) != 1.f) continue;
            const float middle = offset * normal[i];
            b.low[i] = middle - half;
            b.high[i] = middle + half;
        }
        return b;
    }
};

}  // namespace phasetree
