// Holes of meshes: where a mesh is not opaque, rays pass it as if it were not there.
//
// Where the opacity is between 0 and 1 a ray is stopped with that probability. What decides is a number that is hashed
// from the ray and the triangle: so it is the same for a ray whichever way Embree finds its triangles, and other rays
// of the pixel are decided by other numbers. In the mean light is let through by the part 1 − opacity, once for each
// layer. A photon that is stopped, and kept, weighs 1/opacity: a path that gathers it was stopped by the same chance.
//
// Reference: Pharr, Jakob & Humphreys, Physically Based Rendering, 4th edition, 7.1.1 (stochastic alpha test).
#pragma once

#include "embree_core/embree.hpp"
#include "scene/mesh.hpp"

namespace phasetree::tracer {

/// Makes the geometry of a mesh that has an opacity let rays through its holes. The mesh must outlive the geometry.
void leave_holes(RTCGeometry geometry, const Mesh& mesh);

}  // namespace phasetree::tracer
