// The surface of a mesh as a set of pieces: faces, edges and vertices. Each is nearest to the points of one region: a
// face to those of the prism over it, an edge to those between the planes through its ends, a vertex to all other
// points. The distance to the mesh is the minimum of the distances to the pieces, each evaluated only within its
// region.
//
// The sign is that of the dot product of the normal and the vector from the nearest point. For this, an edge's normal
// is the sum of those of its two faces, and a vertex's normal is the sum of those of its faces, weighted by their
// angles (Baerentzen and Aanaes, "Signed Distance Computation Using the Angle Weighted Pseudonormal", 2005).
//
// A mesh with a thickness is a wall on both sides of the surface instead. Its distance is the unsigned one to the
// surface, less half of the thickness, so normals do not matter and the surface need not be closed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "phasetree/math/vec3.hpp"

namespace phasetree::mesh {

enum class PieceKind : std::uint8_t { face, edge, vertex };
inline constexpr std::size_t piece_kinds = 3;

/// The result of evaluating a piece at a point: the squared distance, or `nowhere` if the point is not in its region,
/// and a number with the sign of the distance. For a face, this number is the distance itself.
template <class T>
struct Told {
    T squared, side;
};
inline constexpr float nowhere = 3e38f, farthest = 1.7e19f;  ///< about the root of `nowhere`

template <class T>
Vec3<T> from(const float* origin, const Vec3<T>& p) {
    return {p.x - origin[0], p.y - origin[1], p.z - origin[2]};
}
template <class T>
T along(const float* direction, const Vec3<T>& q) {
    return q.x * direction[0] + q.y * direction[1] + q.z * direction[2];
}

/// Layout: a corner; the unit normal; for each side, the unit vector in the plane that points inward; the corner's
/// signed height over the opposite side, which is negative; the slack by which the face's region extends beyond the
/// face's sides; the unit vector along the longest side; and the coordinates of this side's ends along it, relative to
/// the corner.
///
/// The slack is the rounding error, so that a point straight above a side belongs to the face. The vector from the side
/// to such a point may be mostly rounding error; as a gradient, it would differ from the normals of all adjacent faces.
///
/// Where two sides meet at a small angle, the slack alone would let the region extend far beyond their corner: by the
/// slack divided by the sine of half of the angle. Such corners are ends of the longest side, so the region is also
/// limited along that side.
struct Face {
    static constexpr PieceKind kind = PieceKind::face;
    static constexpr std::size_t corner = 0, normal = 3, inward = 6, opposite = 15, slack = 16, longest = 17,
                                 ends_of_longest = 20, floats = 22;

    template <class T>
    static Told<T> tell(const float* piece, const Vec3<T>& p) {
        const Vec3<T> q = from(piece + corner, p);
        const T height = along(piece + normal, q);
        const T between_sides = min(along(piece + inward, q),
                                    min(along(piece + inward + 3, q) - piece[opposite], along(piece + inward + 6, q)));
        const T t = along(piece + longest, q);
        const T within = min(between_sides, min(t - piece[ends_of_longest], piece[ends_of_longest + 1] - t));
        return {select(less(within, T(-piece[slack])), T(nowhere), height * height), height};
    }
};
/// Layout: one end; the vector to the other end; 1 over its squared length; the normal; the largest angle between it
/// and the normals of the two faces; and three numbers that limit the directions of the region: `bend`, a squared
/// cosine, and a length.
///
/// An edge is nearest only to points in directions between the normals of its two faces, on the outside if it is
/// convex, or in the opposite directions, on the inside if it is concave: elsewhere one of the faces is nearer. With
/// the angle β between the edge's normal and those of the faces, the height over the edge, h = normal · away, is then
/// at least cos β · |away|, or at most the negative of that.
///
/// Beside the end of a spike, another piece is nearest, but by so little that rounding may select an edge, with a
/// height of the wrong sign. So the region is limited to ±h ≥ f cos β · |away| − s, where s bounds the rounding errors:
///
/// * Bent edges, with an angle of at least 30° between the normals of their faces: f is ½.
///   The sign is + if the edge is convex and − if it is concave.
///   Farther than 2 s/cos β from the edge, the sign of h is certain.
/// * Nearly straight edges: f is 0.9. They may be nearest, up to rounding, to points on both sides.
///   The sign is that of h.
///   The limit excludes points beside the edge, where the sign of h is that of its rounding error.
///
/// ±h is computed as |h| + bend · h. For bent edges, that is 2 max(±h, 0); their stored numbers are doubled. Every
/// point to which the edge is nearest stays in the region, because s exceeds the errors proportional to the edge's
/// length, and (1 − f) cos β those proportional to |away|. A cosine of 0 means that directions are not limited: at open
/// edges, edges of faces without area, and where the surface folds back.
struct Edge {
    static constexpr PieceKind kind = PieceKind::edge;
    static constexpr std::size_t end = 0, vector = 3, inverse = 6, normal = 7, largest_angle = 10, bend = 11,
                                 squared_cosine = 12, length = 13, floats = 14;
    static constexpr float slack = 0x1p-22f;  ///< how far the region extends beyond its ends, in lengths of the edge

    template <class T>
    static Told<T> tell(const float* piece, const Vec3<T>& p) {
        const Vec3<T> q = from(piece + end, p);
        const T t = along(piece + vector, q) * piece[inverse];
        const Vec3<T> away{q.x - t * piece[vector], q.y - t * piece[vector + 1], q.z - t * piece[vector + 2]};
        const T squared = dot(away, away), height = along(piece + normal, away);
        const T most = abs(height) + height * piece[bend] + piece[length];
        const T squared_where_allowed = select(less(most * most, squared * piece[squared_cosine]), T(nowhere), squared);
        return {select(less(min(t, 1.f - t), T(-slack)), T(nowhere), squared_where_allowed), height};
    }
};
/// Layout: the position; the normal; and the largest angle between it and the normals of the adjacent faces.
struct Vertex {
    static constexpr PieceKind kind = PieceKind::vertex;
    static constexpr std::size_t position = 0, normal = 3, largest_angle = 6, floats = 7;

    template <class T>
    static Told<T> tell(const float* piece, const Vec3<T>& p) {
        const Vec3<T> q = from(piece + position, p);
        return {dot(q, q), along(piece + normal, q)};
    }
};

/// Call f.template operator()<Kind>() for Face, Edge and Vertex.
template <class F>
void for_each_kind(F&& f) {
    f.template operator()<Face>();
    f.template operator()<Edge>();
    f.template operator()<Vertex>();
}
inline constexpr std::size_t piece_floats[piece_kinds] = {Face::floats, Edge::floats, Vertex::floats};

/// The box around a mesh, and whether the mesh is a solid or a wall, as floats: the centre of the box, its half
/// extents, and half of the wall's thickness, which is 0 for a solid.
inline constexpr std::size_t half_thickness = 6, box_floats = 7;

/// The signed distance, from the result of the nearest piece. Outside the box of a solid the distance is positive
/// regardless of normals: from far away, many pieces are equally far up to rounding.
template <class T, class Condition>
T signed_distance(const Told<T>& nearest, const Condition& is_face, const float* box, const Vec3<T>& p) {
    const T length = sqrt(nearest.squared);
    if (box[half_thickness] > 0) return select(is_face, abs(nearest.side), length) - box[half_thickness];
    const T value = select(is_face, nearest.side, select(less(nearest.side, T(0.f)), -length, length));
    const Vec3<T> q = from(box, p);
    const T beyond = max(abs(q.x) - box[3], max(abs(q.y) - box[4], abs(q.z) - box[5]));
    return select(less(T(0.f), beyond), abs(value), value);
}

/// A list of pieces: the number of each kind, the box, and the pieces, ordered by kind. Among equally near pieces the
/// first one counts.
struct PieceList {
    static constexpr std::size_t head = piece_kinds + box_floats;

    static std::size_t count(const float* data, PieceKind kind) {
        return static_cast<std::size_t>(data[static_cast<std::size_t>(kind)]);
    }
    static std::size_t floats(const float* data) {
        std::size_t sum = head;
        for_each_kind([&]<class Kind>() { sum += count(data, Kind::kind) * Kind::floats; });
        return sum;
    }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        Told<T> nearest{T(nowhere), T(farthest)};
        const float* piece = data + head;
        const auto look_at = [&]<class Kind>() {
            for (std::size_t left = count(data, Kind::kind); left > 0; --left, piece += Kind::floats) {
                const Told<T> told = Kind::tell(piece, p);
                const auto is_nearer = less(told.squared, nearest.squared);
                nearest.squared = select(is_nearer, told.squared, nearest.squared);
                nearest.side = select(is_nearer, told.side, nearest.side);
            }
        };
        look_at.template operator()<Face>();
        const T by_faces = nearest.squared;
        look_at.template operator()<Edge>();
        look_at.template operator()<Vertex>();
        const T is_other = select(less(nearest.squared, by_faces), T(1.f), T(0.f));
        return signed_distance(nearest, less(is_other, T(0.5f)), data + piece_kinds, p);
    }
};

}  // namespace phasetree::mesh
