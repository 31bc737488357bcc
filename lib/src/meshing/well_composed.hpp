// Labels for which the surface of each phase is a manifold.
//
// It is one if the points of each phase are well-composed (Latecki, "3D Well-Composed Pictures", 1997): their voxels
// nowhere touch along an edge, or at a corner, alone. We ask for less, because a cube may have several vertices
// (cube_patches.hpp). In each cube, and for each phase, the edges that lead out of the phase form rings from side to
// side of the cube, since each is linked to one other on both of its sides. Triangles around an edge of the grid have
// vertices in four cubes, so every edge of a triangle leads across one side of a cube, or is the diagonal between two
// cubes that share one edge. What may then go wrong is that
//   - a patch has two rings of a phase, which touch at its vertex;
//   - both faces of a wall across a side are of one patch, so that they may have the same edge there.
#pragma once

#include <functional>

#include "meshing/joined_sides.hpp"
#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

/// Changes labels until neither is so. Labels only rise, and none becomes one that is not beside it already, so it
/// comes to an end; in it a phase of a higher index fills what is narrower than the grid. All sides that phases take
/// turns around have been examined, and are afterwards. The outermost points, which must be vacuum, stay so.
/// `cancelled` is called periodically, and may throw.
void make_well_composed(const Grid&, Labels&, JoinedSides&, const std::function<void()>& cancelled);

}  // namespace phasetree::meshing
