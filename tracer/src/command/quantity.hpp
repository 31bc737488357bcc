// A volume or mass with a value, as in "volume(water) = 330 ml".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "phasetree/io/tree.hpp"
#include "phasetree/measuring/solve.hpp"
#include "scene/scene.hpp"

namespace CLI {
class App;
}

namespace phasetree::tracer {

// Adds the option --unit. `files` names the files that it applies to, such as "SVG: ".
void add_length_unit(CLI::App& command, std::optional<std::string>& name, const std::string& files = "");

// The unit that the option names; else that of the scene; else the metre. Throws UsageError that begins with "--unit:
// ".
LengthUnit length_unit(const std::optional<std::string>& name, const SceneModel& model);

struct Quantity {
    std::string name;    // such as "volume(water)"
    SolveTarget target;  // its value is in cubed scene units, or in kg
    double unit = 1;     // the unit that the user wrote, in units of `target`
    std::string unit_name;

    // Converts a value of the target to the unit that the user wrote.
    double shown(double value) const { return value / unit; }
};

// Parses "volume(PHASE) = VALUE UNIT" or "mass(PHASE) = VALUE UNIT". The phase "total" stands for all phases; in a
// mass, it stands for all phases that have a density. Without a unit, a volume is in cubed units of the scene's
// lengths, and a mass in kg. Densities are in kg/m³. Throws UsageError.
Quantity quantity_of(const std::string& text, const SceneTree& tree, const LengthUnit& lengths,
                     const std::vector<std::pair<Phase, double>>& densities);

}  // namespace phasetree::tracer
