#include <fmt/format.h>

#include "cells/file_format.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree_support/whole_file.hpp"

namespace phasetree {

using cells::CellsFile, cells::CellsFileHeader, cells::Checksum, cells::header_of, cells::InterfaceCell,
    cells::item_bytes, cells::StoredCell;
using support::FileError, support::WholeFile;

namespace fs = std::filesystem;

namespace {

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& items) {
    return std::as_bytes(std::span(items));
}

}  // namespace

CellsFileError::CellsFileError(Reason reason, const fs::path& path, const std::string& what)
    : std::runtime_error(fmt::format("cell file \"{}\": {}", path.string(), what)), reason_(reason) {}

void write_cells(const fs::path& path, const InterfaceCells& cells) {
    const auto [tables, program, settings] = CellsFile::contents(cells);
    std::vector<StoredCell> stored;
    stored.reserve(tables.cells.size());
    for (const InterfaceCell& c : tables.cells) stored.push_back(StoredCell::of(c));
    const auto added_constants = std::as_bytes(std::span(program.constants).subspan(tables.recorded_constants));
    CellsFileHeader h = header_of(program, tables.recorded_constants, settings);
    h.is_coarser = tables.is_coarser;
    h.routines = tables.routine_count;
    const std::array<std::span<const std::byte>, CellsFileHeader::sections> sections{bytes_of(stored),
                                                                                     bytes_of(tables.routines.shapes),
                                                                                     bytes_of(tables.routines.steps),
                                                                                     bytes_of(tables.routines.outputs),
                                                                                     bytes_of(tables.routines.data),
                                                                                     bytes_of(tables.certificates),
                                                                                     bytes_of(tables.first_certificate),
                                                                                     bytes_of(tables.faces),
                                                                                     bytes_of(tables.first_faces),
                                                                                     added_constants};
    Checksum sum;
    for (std::size_t i = 0; i < CellsFileHeader::sections; ++i) {
        h.counts[i] = sections[i].size() / item_bytes[i];
        sum.put(sections[i].data(), sections[i].size());
    }
    h.tables_checksum = sum.get();
    h.header_checksum = h.own_checksum();
    try {
        WholeFile file(path);
        file.write(std::as_bytes(std::span(&h, 1)));
        for (const auto& section : sections) file.write(section);
        file.finish();
    } catch (const FileError& e) {
        throw CellsFileError(CellsFileError::Reason::unusable, path, e.what());
    }
}

}  // namespace phasetree
