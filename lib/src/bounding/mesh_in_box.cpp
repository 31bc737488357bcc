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

// Calls f(normal, largest angle to a face adjacent to the piece) for each piece.
template <class F>
void for_each_normal(const float* data, F&& f) {
    const float* piece = data + PieceList::head;
    mesh::for_each_kind([&]<class Kind>() {
        for (std::size_t left = PieceList::count(data, Kind::kind); left > 0; --left, piece += Kind::floats) {
            const float* n = piece + Kind::normal;
            double largest_angle = 0;
            if constexpr (!std::is_same_v<Kind, Face>) largest_angle = static_cast<double>(piece[Kind::largest_angle]);
            f(glm::dvec3(n[0], n[1], n[2]), largest_angle);
        }
    });
}

bool is_one_face(const float* data) {
    return PieceList::floats(data) == PieceList::head + Face::floats &&
           PieceList::count(data, mesh::PieceKind::face) == 1;
}

}  // namespace

std::optional<FieldInBox> mesh_in_box(const float* pieces, const PointRange& at) {
    glm::dvec3 axis(0);
    for_each_normal(pieces, [&](const glm::dvec3& n, double) { axis += n; });
    const double length = glm::length(axis);
    if (!(length > 1e-3)) return std::nullopt;
    axis /= length;
    double angle = 0;
    for_each_normal(pieces, [&](const glm::dvec3& n, double largest_angle) {
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
