// What `measure` prints.
#pragma once

#include <string>

#include "phasetree/io/tree.hpp"
#include "phasetree/measuring/areas.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/measuring/prove.hpp"

namespace phasetree::tracer {

struct MeasureReport {
    std::string scene;
    const PhaseNames& names;
    const MeasureResult& measures;
    const AreaResult& areas;
    const std::vector<WallThickness>& walls;  // empty unless they were asked for
};

void print_table(const MeasureReport&);
void print_json(const MeasureReport&);

}  // namespace phasetree::tracer
