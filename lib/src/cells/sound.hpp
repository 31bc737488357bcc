#pragma once

#include <string>

#include "cells/tables.hpp"

namespace phasetree::cells {

/// What is wrong with tables that come from elsewhere, "" if nothing: every step must know its operation, read what was
/// written before it, and find all its constants; every certificate must balance. What they compute is not looked at.
/// `program` is the object's, with the cells' constants behind its own.
std::string what_is_unsound(const CellTables&, const Program& program);

}  // namespace phasetree::cells
