#pragma once

#include "building/budget.hpp"
#include "building/build_context.hpp"
#include "building/cell_buffer.hpp"

namespace phasetree::building {

/// Divides a box, in which an object has this program, into cells, with as many threads as TBB has. Neither the cells
/// nor whether the budget is exceeded depends on the number of threads. Throws BuildCancelled or BudgetExceeded.
CellBuffers divide_into_cells(const Bounds&, const WorkingProgram&, const BuildContext&, CellBudget&);

}  // namespace phasetree::building
