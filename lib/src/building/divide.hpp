#pragma once

#include "building/budget.hpp"
#include "building/build_context.hpp"
#include "building/cell_buffer.hpp"

namespace phasetree::building {

/// Cuts a box into cells, by as many threads as TBB has; the result does not depend on them. Throws BuildCancelled, or
/// BudgetExceeded, which depends on nothing else either.
CellBuffers divide_into_cells(const Bounds&, const WorkingProgram&, const BuildContext&, CellBudget&);

}  // namespace phasetree::building
