// The files that a glTF file names: buffers and images in its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phasetree::tracer {

/// Whether its name is that of a glTF file, .gltf or .glb in any case.
bool is_gltf(const std::filesystem::path& file);

/// Where a file is that a document names, by its path from the document's folder. Throws ParameterError of "file" for
/// one that a link leads out of that folder.
std::filesystem::path file_of_gltf(const std::filesystem::path& gltf, const std::string& name);

/// All files that a document names, but for those that cannot be used; none if it cannot be read.
std::vector<std::filesystem::path> files_of_gltf(const std::filesystem::path& gltf);

}  // namespace phasetree::tracer
