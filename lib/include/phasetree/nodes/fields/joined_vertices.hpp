#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phasetree {

/// The distinct positions of a mesh's vertices.
struct JoinedVertices {
    std::vector<glm::vec3> points;  ///< sorted by x, then y, then z; no coordinate is −0
    std::vector<std::uint32_t> of;  ///< for each vertex, the index of its point
};

/// Join the vertices that are meant to be one, for example in STL files, where each triangle has its own three
/// vertices.
///
/// Equal vertices are always joined. If there are still open edges, which are shared by an odd number of triangles,
/// ends of open edges are joined if they differ only by rounding: in each of x, y and z by at most two units in the
/// last place of the mesh's largest coordinate. This covers both noise around zero (1e-20 instead of 0) and differences
/// in the last bit. A mesh that is closed once its equal vertices are joined is not changed any further, however fine
/// it is.
///
/// Vertices are joined only where the choice is unambiguous. A group is joined only if all its vertices are pairwise
/// this close, not merely linked by a chain of close vertices. Unless joining closes the mesh, two corners of one
/// triangle are not joined either, because that would remove the triangle; nor are vertices joined if all triangles at
/// the joined vertex would collapse. The joined point is the vertex nearest to the origin.
///
/// Vertices must be finite, and triangle indices must be valid. The result does not depend on the order of vertices and
/// triangles. Takes O(n log n) time, for sorting.
JoinedVertices join_vertices(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles);

}  // namespace phasetree
