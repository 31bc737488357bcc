#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "phasetree_support/file_error.hpp"

namespace phasetree::support {

/// A file that appears complete or not at all. It is written under a temporary name in the same directory, and finish()
/// renames it. If finish() is not called, the temporary file is removed, and an existing file stays unchanged. If the
/// path is a symbolic link, the link stays, and the file that it points to is replaced or created. A directory, a
/// device or a pipe is never replaced. Temporary files left by processes that were killed while writing the same file
/// are removed. All functions throw FileError.
class WholeFile {
  public:
    explicit WholeFile(const std::filesystem::path&);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    void write(std::span<const std::byte>);
    /// Ends writing, but does not rename the file yet. A closed file uses no descriptor, so there can be many. Closed
    /// files are not locked: another process that writes the same file removes the temporary file.
    void close();
    void finish();
    /// Like finish(), but also waits until the file is on the disk, so that it survives a power failure.
    void finish_on_disk();

  private:
    void open();

    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    bool is_renamed_ = false;
};

}  // namespace phasetree::support
