#include "command/cells_report.hpp"

#include <nlohmann/json.hpp>

#include "command/streams.hpp"

namespace phasetree::tracer {

void add_cells(nlohmann::ordered_json& json, const CellStatistics& s) {
    json["cells"] = s.cells;
    json["routines"] = s.routines;
    json["instructions_per_cell"] = {
        {"median", s.median_instructions}, {"percentile90", s.percentile90_instructions}, {"most", s.max_instructions}};
    json["cell_bytes"] = s.bytes;
    json["cells_are_coarser"] = s.is_coarser;
    json["cell_build_seconds"] = s.build_seconds;
}

void print_cells(const CellStatistics& s) {
    put("{:<14}{} with {} different programs\n", "cells", s.cells, s.routines);
    put("{:<14}median {} instructions, 90th percentile {}, maximum {}\n", "  programs", s.median_instructions,
        s.percentile90_instructions, s.max_instructions);
    put("{:<14}{}\n", "  bytes", s.bytes);
    if (s.is_coarser) put("{:<14}limited; tracing is faster with a larger --max-memory\n", "  memory");
    put("{:<14}{:.3f} s\n", "  build time", s.build_seconds);
}

}  // namespace phasetree::tracer
