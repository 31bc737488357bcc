// Files named in scenes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace phasetree::tracer {

/// Reads a whole file. Throws ParameterError for "file" if it is not a regular file, cannot be read, or is larger than
/// `max_bytes`, which the message calls `limit`.
std::string read_whole_file(const std::filesystem::path& path, std::uintmax_t max_bytes, std::string_view limit);

}  // namespace phasetree::tracer
