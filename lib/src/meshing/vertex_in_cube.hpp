// A vertex is where planes through the interfaces in its cube meet best.
//
// Let pᵢ be points on interfaces, nᵢ the unit normals there, and m a point in their midst. The vertex is m + x, where x
// is the shortest vector for which Σ (nᵢ·(m + x − pᵢ))² is least (Ju et al. 2002); directions in which that sum hardly
// changes are left out (Lindstrom, *Out-of-Core Simplification*, SIGGRAPH 2000). So the vertex is on the edge between
// two faces and in the corner of three.
//
// If the surface is smooth, the planes meet as far on one side of it as m is on the other. For points at the distance d
// to both sides on a surface of curvature κ, m is κd²/2 below it, and the planes meet κd²/2 above. So where all normals
// agree but for a bend, the vertex is halfway to where the planes meet, which is on the surface as far as κ is
// constant.
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
/// apart     the share of the way from the mean by which the vertex stays behind if it is outside of the cube or is not
///           alone. Cubes around a corner of the object may all have that corner for their vertex, and triangles
///           between vertices in one place would have no area.
/// is_alone  whether the cube has no other vertex.
///
/// The vertex may be up to half a cube outside: where an edge of the object only just does not reach into the cube
/// both of its faces do, and the vertex belongs on the edge.
glm::dvec3 vertex_in_cube(std::span<const PlaneInCube>, const glm::dvec3& mean, double apart, bool is_alone);

}  // namespace phasetree::meshing
