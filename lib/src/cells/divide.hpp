#pragma once

#include "cells/found.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// What every step of the division needs.
struct Division {
    const CellOptions& options;
    std::span<const float> constants;
    float reach;     ///< how far beyond its share a cell must be right
    float rounding;  ///< error of a value
    float size;      ///< of the object
};

/// Cuts a box into cells, by as many threads as TBB has; the result does not depend on them. Throws BuildCancelled.
FoundPieces divide_into_cells(const Bounds&, const WorkingProgram&, const Division&);

}  // namespace phasetree
