#pragma once

/// The solid within a surface of triangles, and the wall along one.

#include <cmath>
#include <numbers>

#include "phasetree/nodes/fields/mesh.hpp"
#include "support/set_algebra/primitives.hpp"

namespace phasetree::tests::oracle {

template <class F>
void for_each_triangle(const TriangleMesh& mesh, F&& f) {
    for (const glm::uvec3& t : mesh.triangles)
        f(std::vector<dvec3>{dvec3(mesh.vertices[t.x]), dvec3(mesh.vertices[t.y]), dvec3(mesh.vertices[t.z])});
}

/// How often the surface winds around the point: the sum of the solid angles of its triangles over 4π (Van Oosterom and
/// Strackee, "The Solid Angle of a Plane Triangle", 1983).
inline double winding_number(const TriangleMesh& mesh, const dvec3& p) {
    double sum = 0;
    for_each_triangle(mesh, [&](const std::vector<dvec3>& t) {
        const dvec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double u = glm::length(a), v = glm::length(b), w = glm::length(c);
        sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              u * v * w + glm::dot(a, b) * w + glm::dot(b, c) * u + glm::dot(c, a) * v);
    });
    return sum / (4 * std::numbers::pi);
}

inline double to_triangles(const TriangleMesh& mesh, const dvec3& p) {
    double nearest = absent;
    for_each_triangle(mesh, [&](const std::vector<dvec3>& t) { nearest = std::min(nearest, to_polygon(p, t)); });
    return nearest;
}

inline bool member(const Mesh& n, const dvec3& p) {
    if (n.thickness > 0) return to_triangles(*n.file.content, p) <= static_cast<double>(n.thickness) / 2;
    const double winding = winding_number(*n.file.content, p);
    if (n.rule == "even_odd") return std::lround(winding) % 2 != 0;
    return (n.rule == "non_zero" ? std::abs(winding) : winding) > 0.5;
}
inline double signed_value(const Mesh& n, const dvec3& p) {
    const double nearest = to_triangles(*n.file.content, p);
    if (n.thickness > 0) return nearest - static_cast<double>(n.thickness) / 2;
    return member(n, p) ? -nearest : nearest;
}

}  // namespace phasetree::tests::oracle
