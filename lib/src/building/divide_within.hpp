#pragma once

#include "building/divide.hpp"

namespace phasetree::building {

struct CellsWithinBudget {
    CellBuffers found;
    bool is_coarser = false;  ///< than it would be with more memory
};

/// Cuts a box into cells that take no more than so many bytes, or into one; the result does not depend on the number of
/// threads. Throws BuildCancelled.
CellsWithinBudget divide_within(std::size_t bytes, const Bounds&, const WorkingProgram&, const BuildContext&);

}  // namespace phasetree::building
