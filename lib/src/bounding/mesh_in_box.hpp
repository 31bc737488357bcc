#pragma once

#include <optional>

#include "enclosure/field_in_box.hpp"

namespace phasetree::bounding {

using enclosure::FieldInBox;

/// Bounds the distance to a mesh in a box, given the pieces that can be nearest in it (Mesh::Specialised). Nothing if
/// their normals do not keep within 60° of a common axis.
///
/// The gradient at a point is the normal of its nearest face, or the unit vector between it and its nearest point on an
/// edge or at a vertex. If all faces about that edge or vertex have normals within an angle θ < 90° of an axis, the
/// surface there is the graph of a function over the plane across that axis, with slopes of at most tan θ, and so the
/// gradient is within θ of the axis, too: a vector that leans farther has a part of the surface closer by.
std::optional<FieldInBox> mesh_in_box(const float* pieces, const PointRange&);

}  // namespace phasetree::bounding
