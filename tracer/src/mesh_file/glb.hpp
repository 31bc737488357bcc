// glTF 2.0 in one binary file (Khronos Group, *glTF 2.0 Specification*), for browsers, Blender and game engines.
#pragma once

#include <string>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

/// The bytes of a file with one node per chosen phase: its closed surface, normals and material. Clear phases use the
/// Khronos extensions for transmission, index of refraction and volume, all relative to air, because glTF has no
/// interfaces between two phases. The unit of length is a metre, and z up becomes glTF's y up. Throws std::length_error
/// if the file would exceed 4 GB.
std::string glb_of(const MeshedObject&);

}  // namespace phasetree::tracer
