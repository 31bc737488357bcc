#pragma once

#include <filesystem>
#include <string_view>

#include "phasetree/io/mesh.hpp"

namespace phasetree::io {

/// Readers of the content of a file. Each throws SceneError, which tells the place in the file and quotes nothing of it
/// (Reader::read_file in tree.cpp says why). What a file claims to hold is compared with its size before there is
/// memory for it.
TriangleMesh read_obj(const std::filesystem::path&, std::string_view content);
TriangleMesh read_ply(const std::filesystem::path&, std::string_view content);
TriangleMesh read_stl(const std::filesystem::path&, std::string_view content);

}  // namespace phasetree::io
