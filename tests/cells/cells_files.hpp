// Shared by the tests of cell files: an object, a file of its cells, and the reason why a file is rejected.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "cells/file_header.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

using cells::CellsFileHeader;

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;
using Reason = CellsFileError::Reason;
using support::bytes_of;
using support::TemporaryDirectory;

inline Bytes contents(const fs::path& path) {
    const std::string text = bytes_of(path);
    return {text.begin(), text.end()};
}
inline void put(const fs::path& path, const Bytes& bytes) {
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    REQUIRE(out.good());
}

// Long and short primitives, one with data, blocks whose sites are listed for each cell, a warp, four phases.
inline Phased various() {
    return read_tree(Document::from_text(R"({
        "phases": {"wall": 0, "prism": 0, "shell": 0, "core": 0},
        "tree": {"under": [
            {"set": {"phase": "wall", "of": {"intersection": {"of": [
                {"voronoi_cells": {"size": 0.5, "gap": 0.05, "rounding": 0.02}}, {"box": {"size": [1, 1, 1]}}]}}}},
            {"set": {"phase": "prism", "of": {"smooth_union": {"radius": 0.2, "of": [
                {"extrude": {"height": 0.6, "of": {"polygon": {"points": [[-1, -1], [1, -1], [0.2, 0.9]]}}}},
                {"twist": {"rate": 20, "of": {"torus": {"major": 0.8, "minor": 0.2}}}}]}}}},
            {"thin_shell": {"of": {"sphere": {"radius": 0.7}}, "shell": "shell", "inside": "core",
                            "half_thickness": 0.05}}]}})"))
        .object;
}

inline const CellOptions few{.max_depth = 3};

// The reason why a file is rejected; empty if it is accepted.
inline std::optional<Reason> refusal(const fs::path& path, const Phased& object, const CellOptions& options = few,
                                     std::string* message = nullptr) {
    try {
        (void)read_cells(path, object, options);
    } catch (const CellsFileError& e) {
        if (message) *message = e.what();
        CHECK(std::string(e.what()).find(path.string()) != std::string::npos);
        return e.reason();
    }
    return std::nullopt;
}

inline CellsFileHeader header_of(const Bytes& file) {
    CellsFileHeader h;
    REQUIRE(file.size() >= sizeof h);
    std::memcpy(&h, file.data(), sizeof h);
    return h;
}
inline void set_header(Bytes& file, CellsFileHeader h) {
    h.header_checksum = h.own_checksum();
    std::memcpy(file.data(), &h, sizeof h);
}

// Cells of `various`, and the file that they were written to.
struct Written {
    explicit Written(const CellOptions& with = few) : object(various()), cells(object, with), path(folder / "cells") {
        write_cells(path, cells);
        bytes = contents(path);
    }
    TemporaryDirectory folder;
    Phased object;
    InterfaceCells cells;
    fs::path path;
    Bytes bytes;
};

}  // namespace phasetree::tests
