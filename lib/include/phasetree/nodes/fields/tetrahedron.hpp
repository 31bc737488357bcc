#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The corners are k(1, 1, 1), k(1, −1, −1), k(−1, 1, −1), k(−1, −1, 1), k = r/√3. The mirrors are x = ±y, y = ±z, x =
/// ±z. Exchanging two coordinates, with or without changing both signs, folds space to x ≥ y ≥ |z|. There the nearest
/// boundary point is on the face x + y − z = k, up to the edge from k(1, 1, 1) to k(1, −1, −1).
///
/// Let m be the distance from the face's plane, e = (2x − y + z − 2k)/√6 the distance beyond the edge within the plane,
/// and t = (y + z)/√2 the coordinate along the edge, from its middle. The distance is m where e ≤ 0, and otherwise |(m,
/// e, max(t − √2 k, 0))|. Inside the solid e ≤ 0, because 2x − y + z = 2(x + y − z) − 3(y − z) ≤ 2k there.
struct Tetrahedron {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{
        "tetrahedron", "",
        "fold to x ≥ y ≥ |z|;  m, or |(m, e, max(t − √2 k, 0))| "
        "beyond the edge,  m the height above the face's plane, e the distance beyond its edge, t along the edge, k = "
        "radius/√3",
        "A regular tetrahedron about the origin, with corners on the space diagonals; exact."};
    float radius = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Tetrahedron::radius, Parameter{"radius", "m", "Distance of the corners from the origin.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const float k = radius * 0.57735027f;
        T x = p.x, y = p.y, z = p.z;
        fold(x, y);
        fold(x, z);
        fold(y, z);
        const T m = (x + y - z - k) * 0.57735027f;
        const T e = ((x - k) * 2.f - y + z) * 0.40824829f;
        const T t = max((y + z) * 0.70710678f - 1.4142136f * k, T(0.f));
        return select(less(T(0.f), e), length(Vec3<T>{m, e, t}), m);
    }
    double support(const glm::dvec3& d, float level) const {
        const double k = 0.57735027 * static_cast<double>(radius);
        return k * std::max({d.x + d.y + d.z, d.x - d.y - d.z, d.y - d.x - d.z, d.z - d.x - d.y}) +
               glm::length(d) * static_cast<double>(level);
    }
    /// Below the surface, {f ≤ level} is the tetrahedron whose faces, at r/3 from the origin, are moved inward by
    /// −level.
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred(glm::vec3(radius * 0.57735028f + (level < 0 ? 1.73205f : 1.f) * level));
    }

  private:
    /// Fold two coordinates to a ≥ |b|.
    template <class T>
    static void fold(T& a, T& b) {
        const T most = max(a, b), least = min(a, b);
        const auto swapped = less(most + least, T(0.f));
        a = select(swapped, -least, most);
        b = select(swapped, -most, least);
    }
};

}  // namespace phasetree
