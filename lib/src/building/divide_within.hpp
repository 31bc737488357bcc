#pragma once

#include "building/divide.hpp"

namespace phasetree::building {

struct CellsWithinBudget {
    CellBuffers cells;
    bool is_coarser = false;  ///< whether more memory would have given more cells
};

/// Divides a box into cells that take at most this many bytes, or into a single cell. The result does not depend on the
/// number of threads. Throws BuildCancelled.
CellsWithinBudget divide_within(std::size_t limit_bytes, const Bounds&, const WorkingProgram&, const BuildContext&);

}  // namespace phasetree::building
