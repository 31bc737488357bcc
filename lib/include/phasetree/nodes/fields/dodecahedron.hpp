#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/mirrors.hpp"

namespace phasetree {

/// Mirrors fold the solid to one chamber (mirrors.hpp) with one face. In the chamber, the face's centre lies on the
/// five-fold axis, and the middle of one of its edges lies on the y axis; that edge is parallel to x.
struct Dodecahedron {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{
        "dodecahedron", "",
        "fold to one chamber;  |max((a, b, c), 0)| + min(a, 0),  a the height above the face's plane, b the distance "
        "beyond its edge, c beyond its corner",
        "A regular dodecahedron about the origin. Each coordinate axis passes through the middles of two opposite "
        "edges: on x these edges are parallel to z, on y to x, on z to y. Exact."};
    float radius = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Dodecahedron::radius,
          Parameter{"radius", "m", "Radius of the sphere through the corners.", limits::positive});
    }
    void prepare() const { detail::require_usable(info.name, {radius}); }
    template <class T>
    T distance(const Vec3<T>& p) const {
        Vec3<T> q = p;
        detail::IcosahedralMirrors::fold(q);
        const T a = q.y * 0.850650808f + q.z * 0.525731112f - radius * 0.794654472f;
        const T b = q.y * 0.525731112f - q.z * 0.850650808f - radius * 0.491123473f;
        const T c = q.x - radius * 0.35682209f;
        return detail::IcosahedralMirrors::to_face(a, b, c);
    }
    /// The circumscribed ball has this radius.
    double support(const glm::dvec3& d, float level) const {
        return glm::length(d) * static_cast<double>(radius + level);
    }
    /// (1/φ, φ, 0) and its cyclic permutations are corners.
    Bounds bounds(BoundsQuery&, float level) const { return Bounds::centred(glm::vec3(radius * 0.934173293f + level)); }
};

}  // namespace phasetree
