#pragma once

#include <filesystem>
#include <string>

namespace phasetree::io {

/// The content of a regular file of at most Document::max_bytes. SceneError for everything else; never waits for a
/// pipe or a device.
std::string read_file(const std::filesystem::path& path);

}  // namespace phasetree::io
