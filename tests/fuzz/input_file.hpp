// An input as a file, for readers of files.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "fuzz/target.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace phasetree::fuzz {

// One file, rewritten for each input; in memory where the system has such a folder.
class InputFile {
  public:
    explicit InputFile(const std::string& name) {
        const std::filesystem::path memory = "/dev/shm";
        std::error_code none;
        const bool is_there = std::filesystem::is_directory(memory, none) && ::access(memory.c_str(), W_OK) == 0;
        folder_.emplace(is_there ? memory : std::filesystem::temp_directory_path());
        path_ = *folder_ / name;
    }

    const std::filesystem::path& write(Bytes bytes) {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return path_;
    }

  private:
    std::optional<support::TemporaryDirectory> folder_;
    std::filesystem::path path_;
};

}  // namespace phasetree::fuzz
