#include "scene/expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "phasetree/io/read_kind.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer {

namespace {

Phase phase_of(const std::string& name, const char* key, const ExpectationContext& context, bool allows_vacuum = true) {
    const std::vector<std::string>& names = context.names.names;
    const auto found = std::ranges::find(names, name);
    if (found == names.begin() && !allows_vacuum)
        throw ParameterError(
            key, "this statement is not possible for the vacuum, which surrounds the object; name another phase");
    if (found != names.end()) return Phase{static_cast<std::uint8_t>(found - names.begin())};
    const auto meant = closest(name, names);
    throw ParameterError(
        key, fmt::format("unknown phase \"{}\"{}", name,
                         meant ? fmt::format(" (did you mean \"{}\"?)", *meant) : valid_names("phase", names)));
}

PhaseSet phases_of(const std::vector<std::string>& names, const char* key, const ExpectationContext& context) {
    if (names.empty()) throw ParameterError(key, fmt::format("\"{}\" must name at least one phase", key));
    PhaseSet all;
    for (const std::string& name : names) all = all | PhaseSet::of(phase_of(name, key, context, false));
    return all;
}

std::pair<Phase, Phase> pair_of(const std::vector<std::string>& names, const ExpectationContext& context) {
    if (names.size() != 2 || names[0] == names[1])
        throw ParameterError("phases", "\"phases\" must name two different phases, as in [\"water\", \"glass\"]");
    return {phase_of(names[0], "phases", context), phase_of(names[1], "phases", context)};
}

// A volume or a mass between limits, which are in the unit given here.
template <class Limits>
HasVolume volume_of(const Limits& limits, double unit) {
    if (!limits.at_least && !limits.at_most)
        throw std::invalid_argument("the statement needs \"at_least\", \"at_most\" or both");
    HasVolume volume;
    if (limits.at_least) volume.at_least = *limits.at_least * unit;
    if (limits.at_most) volume.at_most = *limits.at_most * unit;
    if (!(volume.at_least <= volume.at_most))
        throw ParameterError("at_most", "\"at_most\" must not be less than \"at_least\"");
    return volume;
}

// The text of the object that begins here.
std::string text_of(const std::string& document, std::size_t begin) {
    std::size_t end = begin;
    bool is_in_string = false;
    for (int depth = 0; end < document.size(); ++end) {
        const char c = document[end];
        if (c == '\\' && is_in_string) {
            ++end;
            continue;
        }
        if (c == '"') is_in_string = !is_in_string;
        if (is_in_string) continue;
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        if (depth == 0) break;
    }
    return document.substr(begin, end + 1 - begin);
}

template <class Units>
double size_of(const Units& units, const std::string& name) {
    return std::ranges::find(units, name, &NamedUnit::name)->size;
}

template <class Units>
std::vector<std::string_view> names_of(const Units& units) {
    std::vector<std::string_view> names;
    for (const NamedUnit& unit : units) names.push_back(unit.name);
    return names;
}

}  // namespace

std::vector<std::string_view> names_of_volume_units() {
    return names_of(volume_units);
}

std::vector<std::string_view> names_of_mass_units() {
    return names_of(mass_units);
}

MadeStatement PresentParameters::made(const ExpectationContext& c) const {
    return {IsPresent{phase_of(phase, "phase", c)}};
}

MadeStatement ConnectedParameters::made(const ExpectationContext& c) const {
    return {IsConnected{phase_of(phase, "phase", c)}};
}

MadeStatement ClosedParameters::made(const ExpectationContext& c) const {
    const IsClosed statement{phases_of(walls, "walls", c), phases_of(around, "around", c)};
    if (!(statement.walls & statement.inside).empty())
        throw ParameterError("around", "a phase cannot be both a wall and inside the walls");
    return {statement};
}

MadeStatement ApartParameters::made(const ExpectationContext& c) const {
    const auto [first, second] = pair_of(phases, c);
    return {AreApart{first, second, at_least}};
}

MadeStatement TouchingParameters::made(const ExpectationContext& c) const {
    const auto [first, second] = pair_of(phases, c);
    return {AreTouching{first, second}};
}

MadeStatement WallParameters::made(const ExpectationContext& c) const {
    if (reach && !(*reach > 0.5 * at_least))
        throw ParameterError("reach",
                             fmt::format("\"reach\" must be more than half of \"at_least\", {}", 0.5 * at_least));
    return {IsThick{phase_of(phase, "phase", c, false), at_least, reach.value_or(0)}};
}

MadeStatement VolumeParameters::made(const ExpectationContext& c) const {
    const double cubed = c.metres * c.metres * c.metres, size = unit ? size_of(volume_units, *unit) / cubed : 1;
    HasVolume volume = volume_of(*this, size);
    for_each_phase(phases_of(phase, "phase", c).bits,
                   [&](int i) { volume.weights.emplace_back(Phase{static_cast<std::uint8_t>(i)}, 1.0); });
    return {volume, size, unit.value_or("cubed units")};
}

MadeStatement MassParameters::made(const ExpectationContext& c) const {
    const double cubed = c.metres * c.metres * c.metres, size = size_of(mass_units, unit);
    HasVolume volume = volume_of(*this, size);
    for_each_phase(phases_of(phase, "phase", c).bits, [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        if (k >= c.densities.size() || !c.densities[k])
            throw ParameterError("phase",
                                 fmt::format("the phase \"{0}\" has no density; add one beside its material, as "
                                             "in \"{0}\": {{…, \"density\": 1000}}",
                                             c.names.names[k]));
        volume.weights.emplace_back(Phase{static_cast<std::uint8_t>(i)}, *c.densities[k] * cubed);
    });
    return {volume, size, unit};
}

MadeStatement NoDeadNodesParameters::made(const ExpectationContext&) const {
    return {HasNoDeadNodes{}};
}

MadeStatement TightBoundsParameters::made(const ExpectationContext&) const {
    if (!(at_most >= 1))
        throw ParameterError("at_most", fmt::format("\"at_most\" must be at least 1, but is {}", at_most));
    return {HasTightBounds{at_most}};
}

std::vector<Expectation> read_expectations(const Document& document, const ExpectationContext& context) {
    std::vector<Expectation> all;
    const std::optional<Value> list = document.root().find("expect");
    if (!list) return all;
    if (!list->is_array())
        throw document.error(*list, "\"expect\" must be a list of statements, as in [{\"present\": {\"phase\": …}}]");
    for (const Value item : *list)
        with_kind(ExpectationKinds(), document, item, "a statement", [&]<class Kind>(Value member) {
            Expectation one{read_kind<Kind>(document, member, fmt::format("the statement \"{}\"", Kind::info.name),
                                            [&](const Kind& kind) { return kind.made(context); }),
                            {},
                            item.offset()};
            one.text = text_of(document.text(), item.offset());
            all.push_back(std::move(one));
        });
    return all;
}

}  // namespace phasetree::tracer
