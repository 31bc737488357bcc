// Statistics of an object's cells, for `info --cells` and `render --stats`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

void add_cells(nlohmann::ordered_json&, const CellStatistics&);
void print_cells(const CellStatistics&);

}  // namespace phasetree::tracer
