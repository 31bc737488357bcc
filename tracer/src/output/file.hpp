// Files that appear complete or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace phasetree::tracer {

/// Writes a file that appears complete or not at all: it is written under a temporary name in the same directory and
/// renamed. A symbolic link stays one, and what it points at is replaced or, if it is not there, made; a device or a
/// pipe is never replaced. Throws OutputError; then an existing file is untouched and no temporary is left.
void write_file(std::span<const unsigned char> bytes, const std::filesystem::path& path);
inline void write_file(std::string_view text, const std::filesystem::path& path) {
    write_file(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()), path);
}

/// Throws the OutputError that write_file would, as far as it can be known before there is anything to write. Leaves
/// the directory as it was.
void check_file_writable(const std::filesystem::path& path);

}  // namespace phasetree::tracer
