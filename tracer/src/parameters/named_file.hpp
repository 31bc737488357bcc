// Files that scenes name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace phasetree::tracer {

/// All of a file. Throws ParameterError of "file" for one that is none, cannot be read, or is larger than so many
/// bytes, which the message calls `limit`.
std::string read_whole_file(const std::filesystem::path& path, std::uintmax_t most_bytes, std::string_view limit);

}  // namespace phasetree::tracer
