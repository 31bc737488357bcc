#pragma once

#include <functional>
#include <span>

#include "meshing/label_grid.hpp"
#include "meshing/quad_mesh.hpp"

namespace phasetree::meshing {

using VerticesInContact = std::array<std::uint32_t, 6>;

/// Find the triangles that cross or touch others outside common vertices and edges, or that are nearly degenerate to a
/// line or a point. Only pairs in which a triangle belongs to a quadrilateral of `changed` are examined; `changed` must
/// be in ascending order. Things touch if they are closer than `tolerance`. `begin_layer` is called once for each layer
/// of cubes, from any thread; it may throw.
///
/// Returns, for each such pair in ascending order, the vertices of both triangles. The result does not depend on the
/// number of threads.
std::vector<VerticesInContact> vertices_in_contact(const Grid&, const QuadMesh&, std::span<const std::uint32_t> changed,
                                                   double tolerance, const std::function<void()>& begin_layer);

}  // namespace phasetree::meshing
