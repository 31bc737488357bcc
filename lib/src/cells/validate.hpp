#pragma once

#include <string>

#include "cells/tables.hpp"

namespace phasetree::cells {

/// Checks tables that come from elsewhere, so that rays need not check any index: every step has a known operation,
/// reads only slots that were written before it, and finds all its constants; every certificate is a tree in postfix
/// order. What routines compute is not checked. Returns what is wrong, or "". `program` is the object's, with the
/// cells' constants behind its own.
std::string describe_damage(const CellTables&, const Program& program);

}  // namespace phasetree::cells
