#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "phasetree/io/mesh.hpp"

namespace phasetree::io {

/// Readers of the content of a file of each kind. Each throws SceneError, which tells the place in the file and quotes
/// nothing of it (Reader::read_file in tree.cpp says why). What a file claims to hold is compared with its size before
/// there is memory for it.
MeshFile read_obj(const std::filesystem::path&, std::string_view content, std::size_t most_triangles);
MeshFile read_ply(const std::filesystem::path&, std::string_view content, std::size_t most_triangles);
MeshFile read_stl(const std::filesystem::path&, std::string_view content);

/// Drops values that some triangles have and others do not.
template <class T>
void drop_unless_complete(AtCorners<T>& values, const TriangleMesh& mesh) {
    if (values.triangles.size() != mesh.triangles.size()) values = {};
}

/// Throws SceneError if there are more than this many triangles.
void check_triangles(const std::filesystem::path&, const TriangleMesh&, std::size_t most);

}  // namespace phasetree::io
