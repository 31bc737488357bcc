#pragma once

#include "phasetree/nodes/fields/mirrors.hpp"

namespace phasetree {

/// Mirrors fold it to one chamber (mirrors.hpp), which has one face, within a right triangle: from its centre, on the
/// axis n of order five, to the middle of an edge, on the y axis, to a corner. Let a be the height above the face's
/// plane, b how far p is beyond the edge's line, along e, and c how far beyond the corner, along the edge (the x axis).
/// In the chamber b > 0 only where a > 0, and c > 0 only where b > 0; so the distance is a inside and |max((a, b, c),
/// 0)| outside.
struct Dodecahedron {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"dodecahedron", "", "fold to one chamber;  |max((a, b, c), 0)| + min(a, 0)",
                                   "A regular dodecahedron about the origin, with edges across the axes; exact."};
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
        const T zero(0.f);
        return length(Vec3<T>{max(a, zero), max(b, zero), max(c, zero)}) + min(a, zero);
    }
    /// (1/φ, φ, 0) and its cyclic permutations are corners.
    Bounds bounds(BoundsQuery&, float level) const { return Bounds::centred(glm::vec3(radius * 0.934173293f + level)); }
};

}  // namespace phasetree
