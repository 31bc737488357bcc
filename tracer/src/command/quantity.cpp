#include "command/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "command/densities.hpp"
#include "command/errors.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

namespace {

struct Unit {
    std::string_view name;
    double size;  // in m³ or kg
};

constexpr std::array volume_units{Unit{"mm3", 1e-9}, Unit{"ml", 1e-6}, Unit{"cm3", 1e-6}, Unit{"cl", 1e-5},
                                  Unit{"dl", 1e-4},  Unit{"l", 1e-3},  Unit{"dm3", 1e-3}, Unit{"m3", 1}};
constexpr std::array mass_units{Unit{"mg", 1e-6}, Unit{"g", 1e-3}, Unit{"kg", 1}, Unit{"t", 1e3}};
constexpr std::array length_units{LengthUnit{"mm", 1e-3}, LengthUnit{"cm", 1e-2}, LengthUnit{"m", 1},
                                  LengthUnit{"in", 0.0254}};

constexpr std::string_view word_for_all = "total";

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The parts of "KIND(PHASE) = VALUE UNIT".
struct QuantityParts {
    std::string kind, phase, unit;
    double value = 0;
};

QuantityParts parts_of(const std::string& text) {
    const UsageError malformed(
        fmt::format("--until: must be like \"volume(water) = 330 ml\" or \"mass(total) = 2 kg\", but is \"{}\"", text));
    // The name of a phase may contain anything.
    const std::size_t open = text.find('('), equals = text.rfind('=');
    if (open == text.npos || equals == text.npos || equals < open) throw malformed;
    const std::string_view left = trimmed(std::string_view(text).substr(0, equals)),
                           right = trimmed(std::string_view(text).substr(equals + 1));
    if (!left.ends_with(')')) throw malformed;
    const std::size_t inner = left.find('(');
    QuantityParts parts;
    parts.kind = trimmed(left.substr(0, inner));
    parts.phase = trimmed(left.substr(inner + 1, left.size() - inner - 2));
    const auto [end, error] = std::from_chars(right.data(), right.data() + right.size(), parts.value);
    if (error != std::errc() || (parts.kind != "volume" && parts.kind != "mass")) throw malformed;
    parts.unit = trimmed(right.substr(static_cast<std::size_t>(end - right.data())));
    if (!(parts.value > 0 && std::isfinite(parts.value)))
        throw UsageError(fmt::format("--until: the value must be positive and finite, but is \"{}\"", right));
    return parts;
}

// Accepts mL and L, and the digit as a superscript.
const Unit& unit_named(const std::string& name, std::span<const Unit> units) {
    std::string plain = name;
    if (const std::size_t cubed = plain.find("³"); cubed != plain.npos)
        plain.replace(cubed, std::string("³").size(), "3");
    if (plain == "L" || plain == "mL" || plain == "cL" || plain == "dL") plain.back() = 'l';
    const auto found = std::ranges::find(units, plain, &Unit::name);
    if (found != units.end()) return *found;
    std::vector<std::string_view> names;
    for (const Unit& u : units) names.push_back(u.name);
    throw UsageError(fmt::format("--until: unknown unit \"{}\" (choose from {})", name, fmt::join(names, ", ")));
}

// The phases of "total": all but the vacuum.
std::vector<Phase> all_phases(const SceneTree& tree) {
    std::vector<Phase> all;
    for_each_phase(phases(tree.object).bits & ~PhaseSet::of(phasetree::vacuum).bits,
                   [&](int i) { all.push_back(Phase{static_cast<std::uint8_t>(i)}); });
    return all;
}

std::vector<Phase> phases_of(const QuantityParts& parts, const SceneTree& tree) {
    const std::vector<std::string>& names = tree.phases.names;
    const bool is_total = parts.phase == word_for_all && std::ranges::find(names, word_for_all) == names.end();
    if (is_total) return all_phases(tree);
    if (parts.phase == names.front())
        throw UsageError(fmt::format("--until: the vacuum has no {}; choose another phase, or \"total\"", parts.kind));
    return {phase_named(parts.phase, tree, "--until")};
}

void set_masses(Quantity& quantity, const std::vector<Phase>& chosen, const QuantityParts& parts,
                const LengthUnit& lengths, const std::vector<std::pair<Phase, double>>& densities) {
    const double cubed = lengths.metres * lengths.metres * lengths.metres;
    for (const auto& [phase, density] : densities)
        if (density > 0 && std::ranges::find(chosen, phase) != chosen.end())
            quantity.target.weights.emplace_back(phase, density * cubed);
    if (quantity.target.weights.empty())
        throw UsageError(fmt::format("--until: a mass needs a density above 0, as in --density {}=1000",
                                     parts.phase == word_for_all ? "water" : parts.phase));
    quantity.unit = parts.unit.empty() ? 1 : unit_named(parts.unit, mass_units).size;
    quantity.unit_name = parts.unit.empty() ? "kg" : parts.unit;
}

}  // namespace

LengthUnit length_unit(const std::string& name) {
    const auto found = std::ranges::find(length_units, name, &LengthUnit::name);
    if (found != length_units.end()) return *found;
    throw UsageError(fmt::format("--unit: unknown unit \"{}\" (choose from mm, cm, m, in)", name));
}

Quantity quantity_of(const std::string& text, const SceneTree& tree, const LengthUnit& lengths,
                     const std::vector<std::pair<Phase, double>>& densities) {
    const QuantityParts parts = parts_of(text);
    const std::vector<Phase> chosen = phases_of(parts, tree);
    Quantity quantity;
    quantity.name = fmt::format("{}({})", parts.kind, parts.phase);
    if (parts.kind == "mass") {
        set_masses(quantity, chosen, parts, lengths, densities);
    } else {
        for (const Phase phase : chosen) quantity.target.weights.emplace_back(phase, 1.0);
        const double cubed = lengths.metres * lengths.metres * lengths.metres;
        quantity.unit = parts.unit.empty() ? 1 : unit_named(parts.unit, volume_units).size / cubed;
        quantity.unit_name = parts.unit.empty() ? fmt::format("{}³", lengths.name) : parts.unit;
    }
    quantity.target.value = parts.value * quantity.unit;
    if (!(quantity.target.value > 0 && std::isfinite(quantity.target.value)))
        throw UsageError("--until: the value is too large or too small");
    return quantity;
}

}  // namespace phasetree::tracer
