// A volume or mass with a value, as in "volume(water) = 330 ml".
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "phasetree/io/tree.hpp"
#include "phasetree/measuring/solve.hpp"

namespace phasetree::tracer {

// The unit of a scene's lengths.
struct LengthUnit {
    std::string_view name;
    double metres = 1;
};

// The unit of this name: mm, cm, m or in. Throws UsageError that begins with "--unit: ".
LengthUnit length_unit(const std::string& name);

struct Quantity {
    std::string name;    // such as "volume(water)"
    SolveTarget target;  // in cubed units of the scene's lengths, or in kg
    double unit = 1;     // the unit of the value's text, in the unit of `target`
    std::string unit_name;

    // A value of the target in the unit of the text.
    double shown(double value) const { return value / unit; }
};

// Parses "volume(PHASE) = VALUE UNIT" or "mass(PHASE) = VALUE UNIT". The phase "total" stands for all phases; of a
// mass, for all that have a density. Without a unit, a volume is in cubed units of the scene's lengths, and a mass in
// kg. Densities are in kg/m³. Throws UsageError.
Quantity quantity_of(const std::string& text, const SceneTree& tree, const LengthUnit& lengths,
                     const std::vector<std::pair<Phase, double>>& densities);

}  // namespace phasetree::tracer
