#pragma once

/// Winding numbers of a surface of triangles around many points, in double precision. A sum over all triangles, without
/// a hierarchy.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::tests {

/// For each point, how often the surface winds around it: the sum of the solid angles of its triangles over 4π. The
/// surface may be open.
///
/// Half of a triangle's solid angle is the argument of a complex number (Van Oosterom and Strackee, "The Solid Angle of
/// a Plane Triangle", 1983). The arguments are summed by multiplying these numbers, and counting how often the product
/// crosses the negative real axis. That takes one arc tangent per point instead of one per triangle, and eight points
/// are processed at a time.
std::vector<double> winding_numbers(const TriangleMesh&, std::span<const glm::vec3> points);

}  // namespace phasetree::tests
