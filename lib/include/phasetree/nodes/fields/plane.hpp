#pragma once

#include "phasetree/math/unit_vector.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Plane {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"plane", "", "p·n − d",
                                   "The half-space below a plane: the solid is where p·n < d; exact."};
    glm::vec3 normal{0, 0, 1};
    float offset = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&Plane::normal,
          Parameter{"normal", "", "Direction that points out of the solid; any length but zero.", limits::any, true});
        v(&Plane::offset,
          Parameter{"offset", "m", "Distance of the plane from the origin along the normal.", limits::any, true});
    }
    void prepare() {
        if (normal == glm::vec3(0)) throw ModelError("plane: the normal must not be zero");
        normal = unit_vector(normal);
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return dot(p, normal) - offset;
    }
    double rolling_radius(const glm::dvec3&, double) const { return Bounds::infinity; }
    /// If the plane is axis-aligned, it bounds one side of the box. All other sides are infinite.
    Bounds bounds(BoundsQuery&, float level) const {
        Bounds b = Bounds::everything();
        for (int i = 0; i < 3; ++i) {
            if (normal[(i + 1) % 3] != 0.f || normal[(i + 2) % 3] != 0.f) continue;
            if (normal[i] == 1.f) b.high[i] = offset + level;
            if (normal[i] == -1.f) b.low[i] = -(offset + level);
        }
        return b;
    }
};

}  // namespace phasetree
