#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phasetree {

/// The points at which the vertices of a mesh are, each of them once.
struct JoinedVertices {
    std::vector<glm::vec3> points;  ///< sorted by x, then y, then z; no coordinate is −0
    std::vector<std::uint32_t> of;  ///< for each vertex, the index of its point
};

/// Joins the vertices that are meant to be one, as in STL files, where each triangle has its own three.
///
/// Equal vertices are always joined. If triangles then still have open edges, which an odd number of triangles share,
/// ends of open edges are joined where they differ only by rounding: in x, y and z each by at most two units in the
/// last place of the mesh's largest coordinate. That covers both noise about zero (1e-20 instead of 0) and differences
/// in the last bit. A closed mesh, however fine, is left as it is.
///
/// Vertices are joined only where the choice is clear. All of them must be that near to each other: a chain of near
/// vertices that is longer in total stays apart. If the mesh is not closed afterwards, two corners of one triangle
/// stay apart, too, because joining them would remove the triangle, and so do vertices of which no triangle would
/// remain. The joined point is the vertex nearest the origin.
///
/// The result does not depend on the order of vertices and triangles. Vertices must be finite, and the corners of
/// triangles must exist. The time is that of sorting.
JoinedVertices join_vertices(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles);

}  // namespace phasetree
