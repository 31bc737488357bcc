#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "nodes/mesh_repair/contacts.hpp"

namespace phasetree::meshing {

/// A triangle, with the numbers of its vertices and where they are.
struct PlacedTriangle {
    std::array<std::uint32_t, 3> vertices{};
    std::array<glm::dvec3, 3> at{};
};

/// Finds out whether triangles touch each other. The first tests are quick, and decide nearly always; the rest is done
/// by mesh_repair/contacts.hpp. Not thread-safe, because memory is reused.
class TriangleContact {
  public:
    /// `tolerance` is the distance below which things count as touching. It must be at least a millionth of the largest
    /// difference between coordinates of a triangle, or of two that are close to each other.
    explicit TriangleContact(double tolerance);

    /// Whether two triangles cross or touch, other than in vertices and edges that they have in common.
    bool between(const PlacedTriangle&, const PlacedTriangle&);
    /// Whether a triangle is hardly more than a line or a point.
    bool within(const PlacedTriangle&);

  private:
    void place(std::size_t triangle, const PlacedTriangle&, const glm::dvec3& origin);

    double tolerance_;
    mesh::Chain pair_;  // both triangles, with six vertices, some of which may be the same
    mesh::Contacts found_;
};

}  // namespace phasetree::meshing
