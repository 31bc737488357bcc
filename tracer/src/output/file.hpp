// Atomic writing of files.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace phasetree::tracer {

/// Writes a file, which appears complete or not at all: it is written under a temporary name in the same directory and
/// renamed. For a symbolic link, the target is replaced or created and the link is kept. Devices and pipes are written
/// to, never replaced. Throws OutputError, leaving an existing file unchanged and no temporary file.
void write_file(std::span<const unsigned char> bytes, const std::filesystem::path& path);
inline void write_file(std::string_view text, const std::filesystem::path& path) {
    write_file(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()), path);
}

/// Throws the OutputError that write_file would, as far as it can be predicted. Leaves the directory unchanged.
void check_file_writable(const std::filesystem::path& path);

}  // namespace phasetree::tracer
