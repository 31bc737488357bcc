// An input as a file, for what reads files.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fuzz/target.hpp"

namespace phasetree::fuzz {

// One file, written anew for each input; in memory where the system has such a folder.
class InputFile {
  public:
    explicit InputFile(const std::string& name) {
        const std::filesystem::path memory = "/dev/shm";
        std::error_code none;
        const bool is_there = std::filesystem::is_directory(memory, none) && ::access(memory.c_str(), W_OK) == 0;
        std::string folder = ((is_there ? memory : std::filesystem::temp_directory_path()) / "phasetree-fuzz-XXXXXX");
        if (::mkdtemp(folder.data()) == nullptr) broken("there is a temporary folder");
        path_ = std::filesystem::path(folder) / name;
    }
    ~InputFile() {
        std::error_code ignored;
        std::filesystem::remove_all(path_.parent_path(), ignored);
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& write(Bytes bytes) {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return path_;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace phasetree::fuzz
