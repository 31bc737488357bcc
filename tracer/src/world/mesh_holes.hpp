// Holes of meshes: where a mesh is not opaque, rays pass it as if it were not there.
//
// Where the opacity is between 0 and 1 a ray is stopped with that probability. A hash of the ray and the
// triangle decides: so it is the same for a ray whichever way Embree finds its triangles, and other rays
// of the pixel are decided by other numbers. In the mean light is let through by the part 1 − opacity, once for each
// layer. A stored photon weighs 1/opacity, because paths that gather it are stopped there with that probability, too.
//
// Reference: Pharr, Jakob & Humphreys, Physically Based Rendering, 4th edition, 7.1.1 (stochastic alpha test).
#pragma once

#include "embree_core/embree.hpp"
#include "scene/mesh.hpp"

namespace phasetree::tracer {

/// Makes the geometry of a mesh that has an opacity let rays through its holes. The mesh must outlive the geometry.
void leave_holes(RTCGeometry geometry, const Mesh& mesh);

}  // namespace phasetree::tracer
