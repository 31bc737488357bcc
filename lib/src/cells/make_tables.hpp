#pragma once

#include <functional>

#include "building/cell_buffer.hpp"
#include "cells/curvature_code.hpp"
#include "cells/tables.hpp"

namespace phasetree::cells {

/// Makes the tables of cells from what a build has found. Cells with equal programs share one routine. Constants of
/// fused instructions are appended to `constants`. It sets neither how many constants were recorded nor whether the
/// cells are coarser. Throws BuildCancelled.
CellTables make_tables(building::CellBuffers, std::vector<float>& constants, const CurvatureCode&,
                       const std::function<bool()>& cancelled);

}  // namespace phasetree::cells
