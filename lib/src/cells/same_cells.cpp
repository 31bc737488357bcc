#include "cells/file_format.hpp"
#include "phasetree/cells/file.hpp"

namespace phasetree {

using cells::CellsFile, cells::CellsFileHeader, cells::header_of;

// By what a file of the cells would be taken for theirs.
bool are_cells_of(const InterfaceCells& cells, const Phased& object, const CellOptions& options) {
    const auto [tables, program, settings] = CellsFile::contents(cells);
    const CellsFileHeader own = header_of(program, tables.recorded_constants, settings);
    const Program recorded = record(object);
    const CellsFileHeader wanted = header_of(recorded, recorded.constants.size(), CellsFile::settings(object, options));
    const bool has_same_limit =
        tables.is_coarser ? own.most_bytes == wanted.most_bytes : own.most_bytes <= wanted.most_bytes;
    return own.program == wanted.program && own.resolution == wanted.resolution && own.quality == wanted.quality &&
           own.deepest == wanted.deepest && own.opaque == wanted.opaque && has_same_limit;
}

}  // namespace phasetree
