// Atomic writing of files.
#pragma once

#include <filesystem>
#include <list>
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

/// Several files that replace existing ones together. Each is written under a temporary name by add(), and all are
/// renamed by finish(), in the order in which they were added. Without finish(), or if it throws, existing files stay
/// as they are and no new file is left, except that renaming itself may fail after some existing files were replaced.
class FilesTogether {
  public:
    FilesTogether();
    ~FilesTogether();
    FilesTogether(const FilesTogether&) = delete;
    FilesTogether& operator=(const FilesTogether&) = delete;

    /// Both throw OutputError.
    void add(std::string_view bytes, const std::filesystem::path& path);
    void finish();

  private:
    struct File;
    std::list<File> files_;
};

/// Throws the OutputError that write_file would, as far as it can be predicted. Leaves the directory unchanged.
void check_file_writable(const std::filesystem::path& path);

}  // namespace phasetree::tracer
