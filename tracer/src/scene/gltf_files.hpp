// Files referenced by a glTF file: buffers and images in its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gltf/read_gltf.hpp"

namespace phasetree::tracer {

/// Whether the file has the extension .gltf or .glb, ignoring case.
bool is_gltf(const std::filesystem::path& file);

/// The path of a referenced file, given its path relative to the document's folder. Throws ParameterError for "file" if
/// a link leads out of that folder.
std::filesystem::path file_of_gltf(const std::filesystem::path& gltf, const std::string& name);

/// All usable files that a document references; empty if the document cannot be read.
std::vector<std::filesystem::path> files_of_gltf(const std::filesystem::path& gltf);

/// The content of a file and of the files that it references. Throws ParameterError for "file".
gltf::GltfFile read_gltf_file(const std::filesystem::path& file, const gltf::ReadOptions& options);

}  // namespace phasetree::tracer
