#include "bounding/mesh_in_box.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "math/dual.hpp"
#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/fields/mesh.hpp"

namespace phasetree::bounding {

using enclosure::Interval;
using mesh::Edge, mesh::Face, mesh::PieceList, mesh::Vertex;

namespace {

// Gradients within this angle of an axis differ from it by a chord of at most 1. For a wider cone, the ranges would
// include 0 along every coordinate, and say little more than that the field is 1-Lipschitz.
constexpr double widest = std::numbers::pi / 3;

// The heights of the points of a box over a plane.
Interval heights(const float* origin, const glm::dvec3& normal, const PointRange& at) {
    double centre = 0, half = 0;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        centre += normal[i] * (at.centre[k] - static_cast<double>(origin[k]));
        half += std::abs(normal[i]) * at.half_extents[k];
    }
    return {centre - half, centre + half};
}

// The rounding error of the height of a point over a piece.
double rounding_error(const float* data, const PointRange& at) {
    const float* box = data + mesh::piece_kinds;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += std::abs(at.centre[i] - static_cast<double>(box[i])) + at.half_extents[i] +
               2 * static_cast<double>(box[3 + i]);
    return 1e-6 * sum;
}

// Calls f(normal, largest angle to a face adjacent to the piece) for each piece. The gradient of a wall points away
// from its surface on either side, so its normals are those on the side of the box. Returns false if the box is not on
// one side of each piece.
template <class F>
bool for_each_normal(const float* data, const PointRange& at, F&& f) {
    const bool is_wall = data[mesh::piece_kinds + mesh::half_thickness] > 0;
    const double error = rounding_error(data, at);
    const float* piece = data + PieceList::head;
    bool is_on_one_side = true;
    mesh::for_each_kind([&]<class Kind>() {
        for (std::size_t left = PieceList::count(data, Kind::kind); left > 0; --left, piece += Kind::floats) {
            const float* n = piece + Kind::normal;
            glm::dvec3 normal(n[0], n[1], n[2]);
            if (is_wall) {
                const Interval height = heights(piece, normal, at);
                if (!(height.low > error || height.high < -error)) is_on_one_side = false;
                if (height.high < 0) normal = -normal;
            }
            double largest_angle = 0;
            if constexpr (!std::is_same_v<Kind, Face>) largest_angle = static_cast<double>(piece[Kind::largest_angle]);
            f(normal, largest_angle);
        }
    });
    return is_on_one_side;
}

bool is_one_face(const float* data) {
    return PieceList::floats(data) == PieceList::head + Face::floats &&
           PieceList::count(data, mesh::PieceKind::face) == 1;
}

}  // namespace

std::optional<FieldInBox> mesh_in_box(const float* pieces, const PointRange& at) {
    glm::dvec3 axis(0);
    if (!for_each_normal(pieces, at, [&](const glm::dvec3& n, double) { axis += n; })) return std::nullopt;
    const double length = glm::length(axis);
    if (!(length > 1e-3)) return std::nullopt;
    axis /= length;
    double angle = 0;
    for_each_normal(pieces, at, [&](const glm::dvec3& n, double largest_angle) {
        angle = std::max(angle, portable::atan2(glm::length(glm::cross(axis, n)), glm::dot(axis, n)) + largest_angle);
    });
    if (!(angle < widest)) return std::nullopt;

    const auto coordinate = [&](std::size_t i) {
        return Dual(static_cast<float>(at.centre[i]), i == 0 ? 1.f : 0.f, i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f);
    };
    const Dual centre = PieceList::distance(pieces, Vec3<Dual>{coordinate(0), coordinate(1), coordinate(2)});
    FieldInBox field;
    field.value = static_cast<double>(centre.value());
    field.curvature = is_one_face(pieces) ? Interval{} : Interval::all();
    // A unit vector within this angle of the axis differs from it by at most a chord. Normals are rounded to floats.
    const double chord = 2 * std::sin(angle / 2) + 1e-6;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        field.gradient[k] = static_cast<double>(centre.gradient()[i]);
        field.gradients[k] = {std::max(axis[i] - chord, -1.0), std::min(axis[i] + chord, 1.0)};
        field.gradients[k] = {std::min(field.gradients[k].low, field.gradient[k]),
                              std::max(field.gradients[k].high, field.gradient[k])};
    }
    return field;
}

}  // namespace phasetree::bounding
