// Transparent parts of meshes: where a mesh is not opaque, rays pass as if it were not there.
//
// Where the opacity is between 0 and 1, a ray is stopped with that probability. The decision is a hash of the ray and
// the triangle: so it does not depend on the order in which Embree visits triangles, and differs among the rays of a
// pixel. On average the share 1 − opacity of the light passes each layer. A stored photon is weighted by 1/opacity,
// because paths that gather it are stopped there with that probability, too.
//
// Reference: Pharr, Jakob & Humphreys, Physically Based Rendering, 4th edition, 7.1.1 (stochastic alpha test).
#pragma once

#include "embree_core/embree.hpp"
#include "scene/mesh.hpp"

namespace phasetree::tracer {

/// Makes the geometry of a mesh with an opacity let rays through. The mesh must outlive the geometry.
void leave_holes(RTCGeometry geometry, const Mesh& mesh);

}  // namespace phasetree::tracer
