#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "phasetree_support/file_error.hpp"

namespace phasetree::support {

/// A file that appears whole or not at all: it is written under a temporary name in the same directory and renamed by
/// finish(). Without that the temporary file vanishes, and a file that was there is untouched. A symbolic link stays
/// one, and what it points at is replaced or, if it is not there, made; a directory, a device or a pipe never is. What
/// a process left that was killed while it wrote the same file is taken away. All functions throw FileError.
class WholeFile {
  public:
    explicit WholeFile(const std::filesystem::path&);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    void write(std::span<const std::byte>);
    /// Ends the writing, but does not rename the file yet. A closed file uses no descriptor, so there can be many.
    /// Closed files are not locked: another process that writes the same file removes the temporary file.
    void close();
    void finish();
    /// The same, and the file is on the disk and not only in the system's memory, so that it outlives a loss of power.
    void finish_on_disk();

  private:
    void open();

    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    bool is_renamed_ = false;
};

}  // namespace phasetree::support
