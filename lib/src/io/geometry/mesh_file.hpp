#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "phasetree/io/mesh.hpp"

namespace phasetree::io {

/// Readers of file contents, one per format. Each throws SceneError, which gives the position in the file but quotes
/// none of its contents (Reader::read_file in tree.cpp explains why). Sizes claimed by a file are compared with its
/// actual size before memory is allocated.
MeshFile read_obj(const std::filesystem::path&, std::string_view content, std::size_t max_triangles);
MeshFile read_ply(const std::filesystem::path&, std::string_view content, std::size_t max_triangles);
MeshFile read_stl(const std::filesystem::path&, std::string_view content);

/// Drops values that only some triangles have.
template <class T>
void drop_unless_complete(AtCorners<T>& values, const TriangleMesh& mesh) {
    if (values.triangles.size() != mesh.triangles.size()) values = {};
}

/// Throws SceneError if there are more than this many triangles.
void check_triangles(const std::filesystem::path&, const TriangleMesh&, std::size_t most);

}  // namespace phasetree::io
