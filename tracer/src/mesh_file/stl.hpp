// Binary STL, which has triangles and nothing else (3D Systems, StereoLithography Interface Specification, 1989).
#pragma once

#include <string>

#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::tracer {

/// The bytes of a file with one surface.
std::string stl_of(const ClosedMesh&);

}  // namespace phasetree::tracer
