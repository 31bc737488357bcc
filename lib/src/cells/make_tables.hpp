#pragma once

#include <functional>

#include "building/cell_buffer.hpp"
#include "cells/curvature_code.hpp"
#include "cells/tables.hpp"

namespace phasetree::cells {

/// Makes the tables of the cells found by a build. Cells with equal programs share a routine. Appends the constants of
/// fused instructions and the data of specialised ones to `constants`. (Fused: rewriting/fuse.hpp. Specialised:
/// primitives reduced to the data that matter in one cell, rewriting/specialise.hpp.) The caller sets
/// `recorded_constants` and `is_coarser`. Throws BuildCancelled.
CellTables make_tables(building::CellBuffers, std::vector<float>& constants, const CurvatureCode&,
                       const std::function<bool()>& cancelled);

}  // namespace phasetree::cells
