// The files that a .gltf file names: buffers and images in its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phasetree::tracer {

/// Where a file is that a document names, by its path from the document's folder. Throws ParameterError of "file" for
/// one that a link leads out of that folder.
std::filesystem::path file_of_gltf(const std::filesystem::path& gltf, const std::string& name);

/// All files that a document names; none if it cannot be read.
std::vector<std::filesystem::path> files_of_gltf(const std::filesystem::path& gltf);

}  // namespace phasetree::tracer
