#pragma once

#include <string>

#include "cells/tables.hpp"

namespace phasetree::cells {

/// Checks untrusted tables, so that tracing need not check any index. Every step must have a known operation, read only
/// slots written before it, and find all its constants. Every certificate must be a tree in postfix order. The values
/// that routines compute are not checked.
/// Returns a description of the damage, or "" if there is none. `program` is the object's, followed by the cells'
/// constants.
std::string describe_damage(const CellTables&, const Program& program);

}  // namespace phasetree::cells
