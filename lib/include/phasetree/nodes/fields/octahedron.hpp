#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// |x| + |y| + |z| ≤ r. By symmetry, the nearest point to |p| is in the first octant and has its coordinates in the
/// same order. Sort them to a ≥ b ≥ c ≥ 0 and project onto the simplex x + y + z = r, x, y, z ≥ 0. The projection
/// subtracts the same τ from each coordinate that stays positive, and sets the others to 0:
///     c > τ₃ = (a + b + c − r)/3:  on the face, distance √3 τ₃ (negative inside, where the face's plane is nearest)
///     b > τ₂ = (a + b − r)/2:      on an edge, √(2 τ₂² + c²)
///     else                         at a corner, |(a − r, b, c)|
struct Octahedron {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"octahedron", "", "distance to the projection of |p| onto x + y + z = r",
                                   "A regular octahedron about the origin; exact."};
    float radius = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Octahedron::radius,
          Parameter{"radius", "m", "Distance of the corners, which lie on the axes, from the origin.",
                    limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T x = abs(p.x), y = abs(p.y), z = abs(p.z);
        const T most = max(x, y), least = min(x, y);
        const T a = max(most, z), c = min(least, z), b = max(least, min(most, z));
        const T t3 = ((a - radius) + b + c) * (1.f / 3.f);
        const T t2 = ((a - radius) + b) * 0.5f;
        const T edge = sqrt(t2 * t2 * 2.f + c * c);
        const T corner = length(Vec3<T>{a - radius, b, c});
        return select(less(t3, c), t3 * 1.7320508f, select(less(t2, b), edge, corner));
    }
    double support(const glm::dvec3& d, float level) const {
        return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) * static_cast<double>(radius) +
               glm::length(d) * static_cast<double>(level);
    }
    /// Below the surface, {f ≤ level} is |x| + |y| + |z| ≤ r + √3 level.
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred(glm::vec3(radius + (level < 0 ? 1.73205f : 1.f) * level));
    }
};

}  // namespace phasetree
