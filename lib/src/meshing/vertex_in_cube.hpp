// Where the vertex of a cube is: where planes through the interfaces in it meet best.
//
// With points pᵢ on interfaces, unit normals nᵢ there and a point m in their midst, the vertex is m + x for the least x
// that makes Σ (nᵢ·(m + x − pᵢ))² least (Ju et al. 2002; Lindstrom, *Out-of-Core Simplification*, SIGGRAPH 2000, leaves
// out directions in which it hardly changes). So it is on the edge of two faces and in the corner of three.
//
// Of a smooth surface the planes meet as far outside of its bend as m is inside: at height κd²/2 over a surface of
// curvature κ for points at distance d to both sides, m being as far below. Where all normals agree but for a bend the
// vertex is therefore half of the way to where the planes meet, on the surface up to the bend's change.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace phasetree::meshing {

struct PlaneInCube {
    glm::dvec3 point, normal;  ///< of unit length
};

/// In a cube of side 1 whose lowest corner is the origin. There is at least one plane.
///
/// mean      m: the mean of the places where the cube's edges change their phase. There is no plane where labels were
///           changed (well_composed.hpp), but a place all the same: the middle of the edge.
/// apart     Cubes around a corner of the object may all have it for their vertex, and so may two patches of a cube. So
/// that
///           these do not have the very same place, which would make triangles without an area, each stays behind by
///           this share of the way from the mean.
/// is_alone  whether the cube has no other vertex.
///
/// The vertex may be up to half a cube outside: where an edge of the object only just does not reach into the cube
/// both of its faces do, and the vertex belongs on the edge.
glm::dvec3 vertex_in_cube(std::span<const PlaneInCube>, const glm::dvec3& mean, double apart, bool is_alone);

}  // namespace phasetree::meshing
