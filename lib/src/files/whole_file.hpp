#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "files/error.hpp"

namespace phasetree::files {

/// A file that appears whole or not at all: it is written under a temporary name in the same directory and renamed by
/// finish(); without that it vanishes. A symbolic link stays one, and what it points at is replaced; a directory, a
/// device or a pipe never is. All throw FileError.
class WholeFile {
  public:
    explicit WholeFile(const std::filesystem::path&);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    void write(std::span<const std::byte>);
    void finish();

  private:
    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    bool is_renamed_ = false;
};

}  // namespace phasetree::files
