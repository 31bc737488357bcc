// Folding by the mirrors of a symmetry group: reflections, hence isometries, into the part of space between some of the
// mirrors. A point and the nearest boundary point of a symmetric set can be taken on the same side of each mirror, so
// folding preserves distances to the set.
#pragma once

#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree::detail {

/// The mirrors of a regular polygon with n sides, at the angles kπ/n. Taking |y| restricts the angle to [0, nπ/n]. If
/// it is restricted to [0, mπ/n], the mirror at kπ/n, k = ⌈m/2⌉, maps [kπ/n, mπ/n] into [0, kπ/n]. After ⌈log₂ n⌉ such
/// reflections, the angle is in [0, π/n].
struct PolygonMirrors {
    static constexpr int max_folds = 6;  ///< enough for 64 sides
    float folds = 0;
    float cosine[max_folds] = {};
    float sine[max_folds] = {};

    static PolygonMirrors of(float sides) {
        PolygonMirrors result;
        const double step = 3.14159265358979323846 / static_cast<double>(sides);
        int count = 0;
        for (int m = static_cast<int>(sides); m > 1; ++count) {
            m = (m + 1) / 2;
            result.cosine[count] = static_cast<float>(std::cos(step * m));
            result.sine[count] = static_cast<float>(std::sin(step * m));
        }
        result.folds = static_cast<float>(count);
        return result;
    }
    template <class T>
    void fold(T& x, T& y) const {
        y = abs(y);
        for (int i = 0; i < static_cast<int>(folds); ++i) {
            const T beyond = max(y * cosine[i] - x * sine[i], T(0.f)) * 2.f;
            x = x + beyond * sine[i];
            y = y - beyond * cosine[i];
        }
    }
};

/// The 15 mirrors of the regular icosahedron and dodecahedron: the coordinate planes, and the twelve planes
/// perpendicular to (±φ, ±1/φ, ±1)/2 and its cyclic permutations. One of them has the normal n = (−φ, 1/φ, −1)/2.
/// Between x = 0, z = 0 and that plane is a chamber of the group, whose edges are axes of order two (0, 1, 0), three
/// (1/φ, φ, 0) and five (0, φ, 1).
///
/// Its three reflections s, applied in turn where the point is on the mirror's other side, reach the chamber: (s₁ s₂
/// s₃)⁵ is the group's longest element. After the first three coordinate mirrors only a few of the 120 chambers are
/// left, so three rounds suffice.
struct IcosahedralMirrors {
    static constexpr float golden = 1.6180340f;

    template <class T>
    static void fold(Vec3<T>& p) {
        for (int i = 0; i < 3; ++i) {
            p = {abs(p.x), abs(p.y), abs(p.z)};
            const T beyond = min(p.y * (0.5f / golden) - p.x * (0.5f * golden) - p.z * 0.5f, T(0.f)) * 2.f;
            p = {p.x + beyond * (0.5f * golden), p.y - beyond * (0.5f / golden), p.z + beyond * 0.5f};
        }
    }
    /// The distance to a solid with one face in the chamber. The part of the face in the chamber is a right triangle
    /// with corners at the face's centre, at the middle of an edge and at an end of that edge. a is the height above
    /// the face's plane, b the distance beyond the edge's line, c the distance beyond the corner, along the edge. In
    /// the chamber, b > 0 only where a > 0, and c > 0 only where b > 0.
    template <class T>
    static T to_face(const T& a, const T& b, const T& c) {
        const T zero(0.f);
        return length(Vec3<T>{max(a, zero), max(b, zero), max(c, zero)}) + min(a, zero);
    }
};

}  // namespace phasetree::detail
