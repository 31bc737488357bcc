#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "phasetree_support/file_error.hpp"

namespace phasetree::files {

using support::FileError;

/// A regular file, open for reading. Directories, pipes and devices cause a FileError, because reading them may never
/// end.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path&);
    ~RegularFile();
    RegularFile(RegularFile&& other) noexcept;
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    RegularFile& operator=(RegularFile&&) = delete;

    /// The size when the file was opened.
    std::uint64_t size() const { return size_; }
    /// Reads exactly this many bytes; false if fewer are left.
    bool read(void* to, std::size_t count);

  private:
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace phasetree::files
