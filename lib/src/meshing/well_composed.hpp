// Labels for which the surface of each phase is a manifold.
//
// It is one if all points of the grid of any phase are well-composed (Latecki, "3D Well-Composed Pictures", 1997): they
// nowhere touch each other along an edge of their voxels, or at a corner, alone. We ask for less, because a cube may
// have several vertices (cube_patches.hpp). In each cube, and for each phase, the edges that lead out of the phase form
// rings from side to side of the cube. These must be
//   - certain: no side has two phases that take turns around it, which could be joined either way;
//   - apart: no patch has two rings of a phase, which would touch at its vertex; and both faces of a wall across a side
//     are of different patches, or they would touch along an edge there.
#pragma once

#include <functional>

#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

/// Changes labels until that is so. Labels only rise, and none becomes one that is not beside it already, so it comes
/// to an end; in it a phase of a higher index fills what is narrower than the grid. The outermost points, which must be
/// vacuum, stay so. `cancelled` is called now and then, and may throw.
void make_well_composed(const Grid&, Labels&, const std::function<void()>& cancelled);

}  // namespace phasetree::meshing
