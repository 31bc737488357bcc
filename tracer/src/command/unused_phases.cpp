#include "command/unused_phases.hpp"

#include <fmt/format.h>

#include "command/streams.hpp"

namespace phasetree::tracer {

namespace {

// Whether a text with this content stands anywhere in a value.
bool mentions(Value value, const std::string& text) {
    if (value.is_string()) return value.string() == text;
    for (const Value inner : value)
        if (mentions(inner, text)) return true;
    return false;
}

}  // namespace

std::vector<std::string> warnings_of_unused_phases(const Document& document, const PhaseNames& phases, PhaseSet used) {
    std::vector<std::string> warnings;
    const std::optional<Value> declared = document.root().find("phases");
    for (std::size_t i = 1; declared && i < phases.names.size(); ++i) {
        if (used.contains(Phase{static_cast<std::uint8_t>(i)}) || mentions(document.root(), phases.names[i])) continue;
        if (const std::optional<Value> phase = declared->find(phases.names[i]))
            warnings.emplace_back(
                document
                    .error(phase->key_offset(),
                           fmt::format("warning: the phase \"{}\" is declared, and is nowhere", phases.names[i]))
                    .what());
    }
    return warnings;
}

void warn_of_unused_phases(const Document& document, const PhaseNames& phases, PhaseSet used) {
    for (const std::string& warning : warnings_of_unused_phases(document, phases, used)) say("{}\n", warning);
}

}  // namespace phasetree::tracer
