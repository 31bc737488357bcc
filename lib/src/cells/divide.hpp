#pragma once

#include "cells/budget.hpp"
#include "cells/division.hpp"
#include "cells/found.hpp"

namespace phasetree {

/// Cuts a box into cells, by as many threads as TBB has; the result does not depend on them. Throws BuildCancelled, or
/// BudgetExceeded, which depends on nothing else either.
FoundPieces divide_into_cells(const Bounds&, const WorkingProgram&, const Division&, CellBudget&);

}  // namespace phasetree
