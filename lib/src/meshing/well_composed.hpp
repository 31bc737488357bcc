// Labels for which the surface of each phase is a manifold.
//
// The points of a phase are well-composed if none of these is there (Latecki, "3D Well-Composed Pictures", 1997): a
// square of four points of which two opposite ones alone have the phase, and a cube of eight points of which two
// opposite ones alone have it, or alone have it not. Around such a square two parts of the phase's surface would meet
// along an edge, and in such a cube at a point.
#pragma once

#include <functional>

#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

/// Changes labels until the points of each phase are well-composed. Labels only rise, and none becomes one that is not
/// beside it already, so it comes to an end; in it a phase of a higher index fills what is narrower than the grid. The
/// outermost points, which must be vacuum, stay so. `cancelled` is called now and then, and may throw.
void make_well_composed(const Grid&, Labels&, const std::function<void()>& cancelled);

}  // namespace phasetree::meshing
