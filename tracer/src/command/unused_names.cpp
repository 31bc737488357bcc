#include "command/unused_names.hpp"

#include <fmt/format.h>

#include <unordered_set>

#include "command/streams.hpp"

namespace phasetree::tracer {

namespace {

// Maximum number of warnings. Locating a name searches from the beginning of the file, which may contain a million.
constexpr std::size_t most_shapes_reported = 8;

// Adds all strings anywhere in a value.
void add_texts(Value value, std::unordered_set<std::string>& texts) {
    if (value.is_string()) texts.emplace(value.string());
    for (const Value inner : value) add_texts(inner, texts);
}

std::string warning_of(const Document& document, Value declared, fmt::format_string<std::string_view&> message) {
    std::string_view name = declared.key();
    return document.error(declared.key_offset(), "warning: " + fmt::format(message, name)).what();
}

}  // namespace

std::vector<std::string> warnings_of_unused_names(const Document& document, const PhaseNames& phases, PhaseSet used) {
    std::vector<std::string> warnings;
    std::unordered_set<std::string> mentioned;
    add_texts(document.root(), mentioned);
    const Value root = document.root();
    const std::optional<Value> declared = root.find("phases"), shapes = root.find("shapes");
    for (std::size_t i = 1; declared && i < phases.names.size(); ++i) {
        if (used.contains(Phase{static_cast<std::uint8_t>(i)}) || mentioned.contains(phases.names[i])) continue;
        if (const std::optional<Value> phase = declared->find(phases.names[i]))
            warnings.push_back(warning_of(document, *phase, "the phase \"{}\" is declared but never used"));
    }
    std::size_t unused_shapes = 0;
    for (std::size_t i = 0; shapes && i < shapes->size(); ++i) {
        const Value shape = (*shapes)[i];
        if (mentioned.contains(std::string(shape.key())) || ++unused_shapes > most_shapes_reported) continue;
        warnings.push_back(warning_of(document, shape, "the shape \"{}\" is declared but never used"));
    }
    if (unused_shapes > most_shapes_reported)
        warnings.push_back(fmt::format("{}: warning: {} more shapes are never used", document.name(),
                                       unused_shapes - most_shapes_reported));
    return warnings;
}

void warn_of_unused_names(const Document& document, const PhaseNames& phases, PhaseSet used) {
    for (const std::string& warning : warnings_of_unused_names(document, phases, used)) say("{}\n", warning);
}

}  // namespace phasetree::tracer
