// A vertex is the best common point of planes through the interfaces in its cube.
//
// Let pᵢ be points on interfaces, nᵢ the unit normals there, and m a point among them (`mean` below). The vertex is m +
// x, where x is the shortest vector that minimises Σ (nᵢ·(m + x − pᵢ))² (Ju et al. 2002). Directions in which that sum
// hardly changes are ignored (Lindstrom, *Out-of-Core Simplification*, SIGGRAPH 2000). So the vertex is on the edge
// between two faces and at the corner of three.
//
// If the surface is smooth, the planes meet as far on one side of it as m is on the other. For points at the distance d
// to both sides on a surface of curvature κ, m is κd²/2 below it, and the planes meet κd²/2 above it. So if the normals
// differ only by the surface's curvature, the vertex is placed halfway between m and the point where the planes meet,
// which is on the surface as far as κ is constant.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace phasetree::meshing {

struct PlaneInCube {
    glm::dvec3 point, normal;  ///< of unit length
};

/// The vertex in a cube of side 1 whose lowest corner is the origin. There must be at least one plane.
///
/// mean      m: the mean of the positions where the phase changes along the cube's edges. An edge whose labels were
///           changed (well_composed.hpp) has no crossing, hence no plane; its middle counts as the position.
/// apart     if the vertex is outside the cube, or the cube has other vertices, the vertex is moved back towards the
///           mean by this fraction of its distance from it. Otherwise, all cubes around a corner of the object may have
///           that corner as their vertex, and triangles between coincident vertices would have no area.
/// is_alone  whether the cube has no other vertex.
///
/// The vertex may be up to half a cube outside. The two faces that meet at an edge of the object may reach into the
/// cube although the edge itself just misses it. The vertex then belongs on the edge.
glm::dvec3 vertex_in_cube(std::span<const PlaneInCube>, const glm::dvec3& mean, double apart, bool is_alone);

}  // namespace phasetree::meshing
