#include "meshing/triangle_contact.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace phasetree::meshing {

namespace {

bool has(const PlacedTriangle& t, std::uint32_t vertex) {
    return t.vertices[0] == vertex || t.vertices[1] == vertex || t.vertices[2] == vertex;
}

// Whether the vertices of b that are not shared are all on one side of a's plane, and away from it.
bool is_beside_plane(const PlacedTriangle& a, const glm::dvec3& normal, const PlacedTriangle& b, double tolerance) {
    const double distance = tolerance * glm::length(normal);
    bool is_above = true, is_below = true;
    for (std::size_t i = 0; i < 3; ++i) {
        if (has(a, b.vertices[i])) continue;
        const double height = glm::dot(normal, b.at[i] - a.at[0]);
        is_above = is_above && height > distance;
        is_below = is_below && height < -distance;
    }
    return is_above || is_below;
}

// Whether an edge of a separates the triangles in the projection along an axis: b lies on the opposite side of the edge
// from a, except for common vertices, which are ends of the edge.
bool is_separated_by_edge(const PlacedTriangle& a, const PlacedTriangle& b, int axis, double tolerance) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& from = a.at[i];
        const glm::dvec3 along = a.at[(i + 1) % 3] - from;
        const auto side = [&](const glm::dvec3& p) {
            return along[u] * (p[v] - from[v]) - along[v] * (p[u] - from[u]);
        };
        const double distance = tolerance * std::sqrt(along[u] * along[u] + along[v] * along[v]);
        const double inner = side(a.at[(i + 2) % 3]);
        if (!(std::abs(inner) > distance)) continue;
        const double sign = inner > 0 ? -1 : 1;
        bool is_separate = true;
        for (std::size_t k = 0; k < 3 && is_separate; ++k) {
            const bool is_end = b.vertices[k] == a.vertices[i] || b.vertices[k] == a.vertices[(i + 1) % 3];
            is_separate = is_end || sign * side(b.at[k]) > distance;
        }
        if (is_separate) return true;
    }
    return false;
}

int longest_axis(const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(v);
    return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

}  // namespace

TriangleContact::TriangleContact(double tolerance) : tolerance_(tolerance) {
    pair_.points.resize(6);
    pair_.triangles.resize(2);
}

void TriangleContact::place(std::size_t triangle, const PlacedTriangle& t, const glm::dvec3& origin) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto n = static_cast<std::uint32_t>(3 * triangle + i);
        pair_.points[n] = (t.at[i] - origin) * (mesh::touching / tolerance_);
        pair_.triangles[triangle].corners[i] = n;
    }
}

bool TriangleContact::between(const PlacedTriangle& a, const PlacedTriangle& b) {
    if (std::ranges::all_of(b.vertices, [&](std::uint32_t v) { return has(a, v); })) return true;
    const glm::dvec3 n = glm::cross(a.at[1] - a.at[0], a.at[2] - a.at[0]);
    const glm::dvec3 m = glm::cross(b.at[1] - b.at[0], b.at[2] - b.at[0]);
    if (is_beside_plane(a, n, b, tolerance_) || is_beside_plane(b, m, a, tolerance_)) return false;
    const int axis = longest_axis(n);
    if (is_separated_by_edge(a, b, axis, tolerance_) || is_separated_by_edge(b, a, axis, tolerance_)) return false;
    place(0, a, a.at[0]);
    place(1, b, a.at[0]);
    bool is_same_vertex_near = false;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            if (a.vertices[i] == b.vertices[k])
                pair_.triangles[1].corners[k] = pair_.triangles[0].corners[i];
            else if (glm::distance(a.at[i], b.at[k]) < tolerance_)
                is_same_vertex_near = true;
        }
    if (is_same_vertex_near) return true;
    found_ = {};
    mesh::find_contacts(pair_, 0, 1, found_);
    return found_.size() > 0;
}

bool TriangleContact::within(const PlacedTriangle& t) {
    const double longest =
        std::max({glm::distance(t.at[0], t.at[1]), glm::distance(t.at[1], t.at[2]), glm::distance(t.at[2], t.at[0])});
    const double twice_area = glm::length(glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]));
    return !(twice_area > tolerance_ * longest);
}

}  // namespace phasetree::meshing
