#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "nodes/mesh_repair/contacts.hpp"

namespace phasetree::meshing {

/// A triangle, with the numbers and the positions of its vertices.
struct PlacedTriangle {
    std::array<std::uint32_t, 3> vertices{};
    std::array<glm::dvec3, 3> at{};
};

/// Tests whether triangles touch each other. The first tests are quick, and nearly always sufficient;
/// mesh_repair/contacts.hpp decides the remaining cases. Not thread-safe, because memory is reused.
class TriangleContact {
  public:
    /// `tolerance` is the distance below which things count as touching. It must be at least a millionth of the largest
    /// difference between coordinates of a triangle, or of two that are close to each other.
    explicit TriangleContact(double tolerance);

    /// Whether two triangles cross or touch outside the vertices and edges that they have in common.
    bool between(const PlacedTriangle&, const PlacedTriangle&);
    /// Whether a triangle is nearly degenerate to a line or a point.
    bool within(const PlacedTriangle&);

  private:
    void place(std::size_t triangle, const PlacedTriangle&, const glm::dvec3& origin);

    double tolerance_;
    mesh::Chain pair_;  // both triangles, with six vertices, some of which may be the same
    mesh::Contacts found_;
};

}  // namespace phasetree::meshing
