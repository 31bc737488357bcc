// Positions in a cube that depend on its labels alone. With them, triangles cannot cross each other (separation.hpp).
#pragma once

#include <glm/vec3.hpp>

#include "meshing/cube_patches.hpp"

namespace phasetree::meshing {

/// The start of a cube's edge, and the axis along which it leads.
struct CubeEdge {
    int axis = 0;
    glm::ivec3 start{0};

    glm::dvec3 middle() const {
        glm::dvec3 m(start);
        m[axis] = 0.5;
        return m;
    }
};
CubeEdge edge_of_cube(int edge);

/// The mean of the middles of a patch's edges.
glm::dvec3 regular_vertex(const CubePatches&, const CubeLabels&, int patch);

/// A cut of a side of a cube: where the interfaces that cut the side's edges meet in it. If there is a wall across the
/// side, only the interfaces around one of the corners beside the wall belong to the cut.
struct SideCut {
    int corner = -1;       ///< the corner that is cut off, or -1 if two corners or more are on each side
    bool is_wall = false;  ///< whether there is a wall, and so another cut around the opposite corner
    int opposite = -1;     ///< the corner diagonally opposite to `corner`

    /// The middle of the side, or the middle between it and the corner that is cut off.
    glm::dvec3 regular_point(int side) const;
};
/// The cut to which an edge of the side belongs. The phases at the ends of the edge must differ.
SideCut cut_of_side(const CubeLabels&, int side, int edge);

}  // namespace phasetree::meshing
