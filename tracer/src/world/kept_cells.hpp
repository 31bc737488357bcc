// An object's cells in a file, which keeps them from one rendering to the next.
#pragma once

#include <filesystem>
#include <memory>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

/// Reads the object's cells from the file. If there is no such file, or if its cells are those of another object or
/// damaged, the cells are built and the file is written. Throws CellsFileError for a file that is anything but cells,
/// which is left alone, or that cannot be read or written; BuildCancelled and ModelError as building does.
std::shared_ptr<const InterfaceCells> kept_cells(const std::filesystem::path&, const Phased& object,
                                                 const CellOptions&);

}  // namespace phasetree::tracer
