#include <algorithm>
#include <cstring>

#include "cells/cells_file.hpp"
#include "phasetree/cells/file.hpp"

namespace phasetree {

using cells::BuildSettings, cells::CellsFile;

namespace {

// Compares bits, so that −0 differs from 0.
bool are_same(std::span<const float> a, std::span<const float> b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

// Whether a recorded program equals the program of cells, which have appended their constants to it.
bool is_program_of(const Program& recorded, const Program& of_cells, std::size_t recorded_constants) {
    const auto same_instruction = [](const Instruction& a, const Instruction& b) {
        return a.op == b.op && a.a == b.a && a.b == b.b && a.data == b.data;
    };
    const auto same_output = [](const Output& a, const Output& b) { return a.phase == b.phase && a.value == b.value; };
    return std::ranges::equal(recorded.instructions, of_cells.instructions, same_instruction) &&
           std::ranges::equal(recorded.outputs, of_cells.outputs, same_output) &&
           are_same(recorded.lipschitz, of_cells.lipschitz) &&
           are_same(recorded.constants, std::span(of_cells.constants).first(recorded_constants));
}

}  // namespace

bool are_cells_of(const InterfaceCells& cells, const Phased& object, const CellOptions& options) {
    const auto [tables, program, own] = CellsFile::contents(cells);
    const BuildSettings wanted = CellsFile::settings(object, options);
    const bool has_same_limit =
        tables.is_coarser ? own.max_bytes == wanted.max_bytes : own.max_bytes <= wanted.max_bytes;
    const bool has_same_settings = own.resolution == wanted.resolution && own.quality == wanted.quality &&
                                   own.max_depth == wanted.max_depth && own.opaque.bits == wanted.opaque.bits &&
                                   has_same_limit;
    // Compare the program last, because recording it may take the longest.
    return has_same_settings && is_program_of(record(object), program, tables.recorded_constants);
}

}  // namespace phasetree
