#include "scene/phase_entry.hpp"

namespace phasetree::tracer {

bool is_phase_parameter(std::string_view key) {
    bool is_one = false;
    PhaseParameters::parameters([&](auto, const Parameter& p) { is_one = is_one || p.name == key; });
    return is_one;
}

PhaseEntry phase_entry(const Document& document, Value value) {
    PhaseEntry entry;
    if (!value.is_object()) return entry;
    std::size_t others = 0;
    for (const Value member : value) {
        if (is_phase_parameter(member.key())) {
            entry.has_parameters = true;
        } else {
            ++others;
            entry.material = member;
        }
    }
    if (others != 1) entry.material.reset();
    if (!entry.has_parameters) return entry;
    ObjectReader reader(document, value, "the phase");
    read_parameters(reader, entry.parameters);
    if (others > 1) throw document.error(value, "a phase must have one material, and may have a \"density\" beside it");
    return entry;
}

}  // namespace phasetree::tracer
