#include "command/densities.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "command/errors.hpp"
#include "command/unknown_phase.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

namespace {

// Parses PHASE=VALUE. The name of a phase may contain "=", a number does not.
std::pair<Phase, double> density_of(const std::string& text, const SceneTree& tree) {
    const std::size_t split = text.rfind('=');
    double value = 0;
    if (split == std::string::npos || !CLI::detail::lexical_cast(text.substr(split + 1), value) ||
        !(value >= 0 && value <= 1e12))
        throw UsageError(
            fmt::format("--density: must be PHASE=VALUE, with a value from 0 to 1e12, but is \"{}\"", text));
    const std::string name = text.substr(0, split);
    if (name == tree.phases.names.front()) throw UsageError("--density: the vacuum has no density");
    return {phase_named(name, tree, "--density"), value};
}

}  // namespace

void add_densities(CLI::App& command, std::vector<std::string>& texts) {
    command.add_option("--density", texts, "Density of a phase in kg/m³, for masses; repeat it for other phases")
        ->option_text("PHASE=VALUE")
        ->allow_extra_args(false);
}

std::vector<std::pair<Phase, double>> densities_of(const std::vector<std::string>& texts, const SceneTree& tree) {
    std::vector<std::pair<Phase, double>> all;
    for (const std::string& text : texts) {
        const auto density = density_of(text, tree);
        for (const auto& [phase, value] : all)
            if (phase == density.first)
                throw UsageError(
                    fmt::format("--density: \"{}\" has two densities; give it one", tree.phases.names[phase.index]));
        all.push_back(density);
    }
    return all;
}

Phase phase_named(const std::string& name, const SceneTree& tree, const std::string& option) {
    const std::vector<std::string>& names = tree.phases.names;
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (found != names.end() && phases(tree.object).contains(static_cast<int>(index)))
        return Phase{static_cast<std::uint8_t>(index)};
    std::vector<std::string> valid;
    for (std::size_t i = 1; i < names.size(); ++i)
        if (phases(tree.object).contains(static_cast<int>(i))) valid.push_back(names[i]);
    throw unknown_phase(option, name, valid);
}

}  // namespace phasetree::tracer
