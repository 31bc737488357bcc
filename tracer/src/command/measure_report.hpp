// What `measure` prints.
#pragma once

#include <string>

#include "phasetree/io/tree.hpp"
#include "phasetree/measuring/areas.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/measuring/prove.hpp"
#include "scene/length_unit.hpp"

namespace phasetree::tracer {

// All numbers are in SI units, as in the JSON. The table converts them to the scene's unit of length.
struct MeasureReport {
    std::string scene;
    LengthUnit unit;
    const PhaseNames& names;
    const MeasureResult& measures;
    const AreaResult& areas;
    const std::vector<WallThickness>& walls;  // empty unless they were asked for
};

void print_table(const MeasureReport&);
void print_json(const MeasureReport&);

}  // namespace phasetree::tracer
