#pragma once

#include "phasetree/math/unit_vector.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Slab {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"slab", "", "|p·n − d| − t/2", "The space between two parallel planes; exact."};
    glm::vec3 normal{0, 0, 1};
    float offset = 0;
    float thickness = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Slab::normal, Parameter{"normal", "", "Normal of the slab; any length but zero.", limits::any, true});
        v(&Slab::offset, Parameter{"offset", "m", "Distance of the slab's middle from the origin along the normal.",
                                   limits::any, true});
        v(&Slab::thickness, Parameter{"thickness", "m", "Distance between the two planes.", limits::positive});
    }
    void prepare() {
        if (normal == glm::vec3(0)) throw ModelError("slab: the normal must not be zero");
        normal = unit_vector(normal);
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return abs(dot(p, normal) - offset) - thickness * 0.5f;
    }
    /// If the slab is axis-aligned, it bounds two sides of the box. All other sides are infinite.
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
