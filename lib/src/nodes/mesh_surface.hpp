#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::mesh {

/// An edge of a closed surface: its ends, and the two triangles that have it. The first triangle has it from the first
/// end to the second.
struct SharedEdge {
    std::array<std::uint32_t, 2> ends, triangles;
};

/// The surface of a solid: corners at the same point are one, triangles with two equal corners are gone, each edge has
/// two triangles with the same side outward, and all triangles about a vertex are neighbours in one ring. Vertices and
/// triangles are in rising order, so that the surface, and with it each distance, is the same to the last bit in
/// whatever order a file has them.
struct Surface {
    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> numbers;  ///< of the triangles in the file, from 1
    std::vector<SharedEdge> edges;
    std::vector<glm::dvec3> normals;  ///< of the triangles, of length 1

    glm::dvec3 at(std::uint32_t vertex) const { return vertices[vertex]; }
    glm::dvec3 corner(std::uint32_t triangle, int i) const { return at(triangles[triangle][i]); }
};

/// Throws ModelError if the triangles are not such a surface; `name` is what it calls the mesh.
Surface surface_of(const TriangleMesh&, const std::string& name);

/// Throws ModelError if two triangles cross each other, or touch along more than they share.
void require_no_crossing(const Surface&, const std::string& name);

/// Throws ModelError if the outside of a triangle is where the solid is: the surface as a whole, or one of several, is
/// turned inside out.
void require_outward(const Surface&, const std::string& name);

/// The boxes around the triangles.
std::vector<Bounds> boxes_of(const Surface&);

/// A point as text for people.
std::string written(const glm::dvec3&);

}  // namespace phasetree::mesh
