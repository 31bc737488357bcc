// glTF 2.0 in one binary file (Khronos Group, *glTF 2.0 Specification*), for browsers, Blender and game engines.
#pragma once

#include <string>

#include "mesh_file/meshed_object.hpp"

namespace phasetree::tracer {

/// The bytes of a file: for each chosen phase a node with its closed surface, normals and material. What is clear has
/// the extensions of Khronos for transmission, index and volume, which are relative to air: glTF knows no interface
/// between two phases. A unit of length is a metre, and z is turned up to glTF's y. Throws std::length_error if it
/// would have more than 4 GB.
std::string glb_of(const MeshedObject&);

}  // namespace phasetree::tracer
