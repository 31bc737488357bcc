#pragma once

#include <filesystem>

#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree {

/// The triangles of an OBJ, PLY or STL file, which its name's ending tells. Faces of more corners become fans. Throws
/// SceneError, which quotes nothing of the file.
TriangleMesh read_mesh(const std::filesystem::path&);

}  // namespace phasetree
