// PLY (Turk, *The PLY Polygon File Format*, 1994): each triangle once, with the phases on both of its sides.
#pragma once

#include <string>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

/// The bytes of a binary file. A face has beside its vertices `behind` and `front`, the numbers of the phases on its
/// sides, of which the header has the names; its vertices are counterclockwise as seen from the phase in front.
/// It has the colour of the phase behind, or of the one in front if the one behind is not chosen.
std::string ply_of(const MeshedObject&);

}  // namespace phasetree::tracer
