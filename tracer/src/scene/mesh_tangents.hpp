// The tangents of a mesh, for normal maps (shading/normal_map.hpp): at each corner of a triangle, the direction along
// the surface in which the texture coordinate u increases.
//
// A triangle with sides a and b, along which (u, v) change by (u₁, v₁) and (u₂, v₂), has the direction
//     ∂p/∂u ∥ (v₂ a − v₁ b) · sign(u₁ v₂ − u₂ v₁).
// A corner has the mean over all triangles around it, each made perpendicular to the corner's normal and weighted by
// its angle there. Triangles are averaged if they agree in the corner's position, normal and texture coordinates, and
// in whether they mirror the image. Programs that bake normal maps do nearly the same.
//
// Reference: Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008. Weights and groups follow it, except that
// corners are averaged even if no triangles with common edges connect them.
#pragma once

#include "scene/mesh.hpp"

namespace phasetree::tracer {

/// For each corner a unit tangent, or 0 where the texture coordinates do not define one, and whether the triangle shows
/// the image as it is (1) or mirrored (−1). The mesh must have texture coordinates.
AtCorners<glm::vec4> tangents_of(const Mesh& mesh);

}  // namespace phasetree::tracer
