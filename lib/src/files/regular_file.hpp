#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "files/error.hpp"

namespace phasetree::files {

/// A regular file, open for reading. Directories, pipes and devices are a FileError: to read one may never end.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path&);
    ~RegularFile();
    RegularFile(RegularFile&& other) noexcept;
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    RegularFile& operator=(RegularFile&&) = delete;

    /// When it was opened.
    std::uint64_t size() const { return size_; }
    /// The next bytes, all of them; false if there are not so many.
    bool read(void* to, std::size_t count);

  private:
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace phasetree::files
