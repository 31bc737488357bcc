#pragma once

#include <filesystem>
#include <string>

#include "phasetree/io/document.hpp"

namespace phasetree::io {

/// The content of a regular file of at most this many bytes. Throws SceneError for anything else; never waits for a
/// pipe or a device.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes = Document::max_bytes);

}  // namespace phasetree::io
