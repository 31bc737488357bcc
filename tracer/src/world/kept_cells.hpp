// A file that caches an object's cells between renderings.
#pragma once

#include <filesystem>
#include <memory>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

/// Reads the object's cells from the file. If the file does not exist, or has damaged cells or those of another object,
/// the cells are built and the file is written. Throws CellsFileError if the file cannot be read or written, or if it
/// is not a file of cells, in which case it is not changed. Throws BuildCancelled and ModelError as building does.
std::shared_ptr<const InterfaceCells> kept_cells(const std::filesystem::path&, const Phased& object,
                                                 const CellOptions&);

}  // namespace phasetree::tracer
