// Changes labels so that the surface of each phase is a manifold.
//
// The surface is a manifold if the points of each phase are well-composed (Latecki, "3D Well-Composed Pictures", 1997):
// their voxels nowhere touch only along an edge or only at a corner. We require less, because a cube may have several
// vertices (cube_patches.hpp). In each cube, the edges with exactly one end in a given phase form closed rings: such an
// edge lies on two sides of the cube, and on each of them it is linked to one other such edge. The two triangles of a
// grid edge have their vertices in the four cubes around it. So an edge of a triangle joins two cubes with a common
// side or, as the diagonal, two cubes that share only an edge. The surface is therefore a manifold unless one of two
// problems occurs (cube_patches.hpp defines patches and walls):
//   - a patch has two rings of a phase, which touch at its vertex;
//   - both faces of a wall across a side (WallAcross in cube_patches.hpp) belong to the same patch, so that they may
//     share an edge there.
#pragma once

#include <functional>

#include "meshing/joined_sides.hpp"
#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

/// Changes labels until neither problem occurs. A label is only ever replaced by a higher one that a neighbouring point
/// has, so this terminates. As a result, a phase of a higher index fills gaps narrower than the grid. Before the call,
/// all sides around which phases alternate must have been examined (JoinedSides); the same holds afterwards. The
/// outermost points must be vacuum, and stay so. `cancelled` is called periodically, and may throw.
void make_well_composed(const Grid&, Labels&, JoinedSides&, const std::function<void()>& cancelled);

}  // namespace phasetree::meshing
