// Repairs a mesh that is not a clean surface.
//
// The mesh becomes a chain: triangles with integer multiplicities, whose vertices are points of a lattice. Every step
// below maps chains to chains, and keeps a closed chain closed, whatever is rounded:
//
//   weld         vertices are rounded to the lattice, close ones are joined, and equal triangles are added up
//   orient       triangles that share an edge get the same orientation, and shells that are inside out are turned
//   close_holes  triangles between the boundary edges make the chain closed
//   arrange      triangles are split until none of them cross; those that have become equal are added up
//   cells        the parts into which the triangles divide space, and how often the chain winds around each
//   boundary     the triangles between a cell inside and one outside
//
// A closed chain winds around each cell a whole number of times, so which cells are inside is decided without rounding.
// See Zhou et al., "Mesh Arrangements for Solid Geometry" (2016), and Jacobson et al., "Robust Inside-Outside
// Segmentation using Generalized Winding Numbers" (2013).
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::mesh {

/// A triangle of a chain, which counts `times` times. If this is negative, it counts with the opposite orientation.
struct ChainTriangle {
    std::array<std::uint32_t, 3> corners;
    std::int32_t times = 1;
};

/// Coordinates of points are whole numbers of lattice steps, about 2²³ at most; as floats and in metres they are exact.
struct Chain {
    double step = 1;  ///< in metres
    std::vector<glm::dvec3> points;
    std::vector<ChainTriangle> triangles;

    const glm::dvec3& corner(std::size_t triangle, std::size_t i) const {
        return points[triangles[triangle].corners[i]];
    }
    /// Has the length of twice the area.
    glm::dvec3 normal(std::size_t triangle) const {
        const glm::dvec3& a = corner(triangle, 0);
        return glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
    }
    glm::dvec3 middle(std::size_t triangle) const {
        return (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0;
    }
    Bounds box(std::size_t triangle) const {
        Bounds b;
        for (std::size_t i = 0; i < 3; ++i)
            b = unite(b, {glm::vec3(corner(triangle, i)), glm::vec3(corner(triangle, i))});
        return b;
    }
};

/// Anything closer than this, in lattice steps, counts as touching. It exceeds both the distances by which points are
/// rounded and the rounding errors of the node's distances. So no walls remain that are too thin for these distances to
/// resolve.
inline constexpr double touching = 4;

/// A triangle's use of an edge, and whether the triangle traverses it from the low to the high vertex.
struct EdgeOfChain {
    std::uint32_t low, high, triangle;
    bool is_rising;
};

/// Sorted by vertices, then by triangles.
std::vector<EdgeOfChain> edges_of(const Chain&);

/// Calls f(span) with all uses of each edge.
template <class F>
void for_each_edge(std::span<const EdgeOfChain> edges, F&& f) {
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
        while (next < edges.size() && edges[next].low == edges[i].low && edges[next].high == edges[i].high) ++next;
        f(edges.subspan(i, next - i));
    }
}

/// Round vertices to the lattice, and join those that touch. Of several equal triangles, one remains, or none if
/// equally many face each way. The result does not depend on the order of vertices and triangles.
Chain welded(const TriangleMesh&);

/// Add up equal triangles, remove those that count zero times, and sort.
void merge_equal(std::vector<ChainTriangle>&);

}  // namespace phasetree::mesh
