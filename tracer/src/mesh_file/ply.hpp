// PLY (Turk, *The PLY Polygon File Format*, 1994), with each triangle once and the phases on both sides.
#pragma once

#include <string>

#include "mesh_file/meshed_object.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::tracer {

/// The bytes of a binary file. In addition to its vertices, a face has `behind` and `front`, the numbers of the phases
/// on its sides; the header lists their names. Vertices are counterclockwise as seen from the phase in front. A face
/// has the colour of the phase behind it, or of the one in front if the one behind is not chosen.
std::string ply_of(const MeshedObject&);

/// The bytes of a binary file of triangles alone. Reading it gives the same mesh, bit for bit.
std::string ply_of(const TriangleMesh&);

}  // namespace phasetree::tracer
