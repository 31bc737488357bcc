#pragma once

#include <filesystem>
#include <memory>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

// An object's cells from a file that keeps them from one rendering to the next. If there is none, or if its cells are
// those of something else or damaged, they are built, and the file is written. Throws CellsFileError for a file that is
// anything but cells, which is left alone, or cannot be read or written; BuildCancelled, ModelError as building does.
std::shared_ptr<const InterfaceCells> kept_cells(const std::filesystem::path&, const Phased& object,
                                                 const CellOptions&);

}  // namespace phasetree::tracer
