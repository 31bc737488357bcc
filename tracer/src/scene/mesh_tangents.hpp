// The tangents of a mesh: at each corner of a triangle the direction along the surface in which the texture coordinate
// u grows, for maps of normals (shading/normal_map.hpp).
//
// A triangle with the sides a and b, along which (u, v) grow by (u₁, v₁) and (u₂, v₂), has the direction
//     ∂p/∂u ∥ (v₂ a − v₁ b) · sign(u₁ v₂ − u₂ v₁).
// A corner has the mean of those of all triangles around it, each made perpendicular to the corner's normal and
// weighted by its angle there. Triangles count together if they agree in the corner's place, normal and texture
// coordinates, and in whether they show the image mirrored. Programs that bake normals do nearly the same.
//
// Reference: Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008. Weights and groups follow it, except that
// corners count together even if no triangles with common edges connect them.
#pragma once

#include "scene/mesh.hpp"

namespace phasetree::tracer {

/// For each corner a tangent of unit length, or 0 where the coordinates tell none, and whether the triangle shows the
/// image as it is (1) or mirrored (−1). The mesh has texture coordinates.
AtCorners<glm::vec4> tangents_of(const Mesh& mesh);

}  // namespace phasetree::tracer
