#pragma once

#include "cells/division.hpp"
#include "cells/found.hpp"

namespace phasetree {

/// Cuts a box into cells, by as many threads as TBB has; the result does not depend on them. Throws BuildCancelled.
FoundPieces divide_into_cells(const Bounds&, const WorkingProgram&, const Division&);

}  // namespace phasetree
