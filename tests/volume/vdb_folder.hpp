#pragma once

/// OpenVDB files for tests, written by OpenVDB itself.

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "volume/read_volume.hpp"

namespace phasetree::tests {

class VdbFolder {
  public:
    VdbFolder() { openvdb::initialize(); }

    std::filesystem::path path(const std::string& name) const { return directory_.path() / name; }
    std::filesystem::path write(const std::string& name, const openvdb::GridCPtrVec& grids,
                                std::uint32_t compression = 6) const {
        openvdb::io::File file(path(name).string());
        file.setCompression(compression);
        file.write(grids);
        return path(name);
    }
    std::filesystem::path write_bytes(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }

  private:
    support::TemporaryDirectory directory_;
};

/// Why a file was rejected, without its name; "nothing" if it was read.
template <class Read>
std::string said_by(const Read& read) {
    try {
        (void)read();
    } catch (const std::runtime_error& e) {
        const std::string text = e.what();
        return text.substr(text.find("\": ") + 3);
    }
    return "nothing";
}
inline std::string said_of_level_set(const std::filesystem::path& path, const std::string& grid = "") {
    return said_by([&] { return tracer::read_level_set(path, grid); });
}
inline std::string said_of_labels(const std::filesystem::path& path, const std::string& grid = "") {
    return said_by([&] { return tracer::read_label_grid(path, grid); });
}
inline std::string said_of_numbers(const std::filesystem::path& path, const std::string& grid = "") {
    return said_by([&] { return tracer::read_number_grid(path, grid); });
}

}  // namespace phasetree::tests
