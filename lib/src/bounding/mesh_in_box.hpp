#pragma once

#include <optional>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox;

/// Bounds the distance to a mesh in a box, given the pieces that can be nearest in it (Mesh::Specialised). Returns
/// nullopt if their normals are not within 60° of a common axis.
///
/// The gradient at a point is the normal of its nearest face, or the unit vector between the point and its nearest
/// point on an edge or at a vertex. Suppose that all faces at that edge or vertex have normals within an angle θ < 90°
/// of an axis. Then the surface there is the graph of a function over the plane across that axis, with slopes of at
/// most tan θ. So the gradient is also within θ of the axis: along a vector that leans farther, another part of the
/// surface would be closer. The same holds on both sides of a wall's surface, except at its open edges, where
/// nullopt is returned, too.
std::optional<FieldInBox> mesh_in_box(const float* pieces, const PointRange&);

}  // namespace phasetree::bounding
