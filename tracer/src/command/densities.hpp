// Densities of phases, for masses.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "phasetree/io/tree.hpp"
#include "phasetree/model/phase.hpp"
#include "scene/scene.hpp"

namespace CLI {
class App;
}

namespace phasetree::tracer {

// Adds the option --density PHASE=VALUE, which may be repeated.
void add_densities(CLI::App& command, std::vector<std::string>& texts);

// The densities of the object's phases in kg/m³: those of the option, which are parsed here, and those of the scene for
// other phases. Throws UsageError if a value of the option is malformed, names a phase that the object lacks, or
// repeats a phase.
std::vector<std::pair<Phase, double>> densities_of(const std::vector<std::string>& texts, const SceneTree& tree,
                                                   const SceneModel& model);

// The phase of the object with this name. Throws UsageError that begins with the option's name.
Phase phase_named(const std::string& name, const SceneTree& tree, const std::string& option);

}  // namespace phasetree::tracer
