// An entry of "phases" in a scene file: a material, and other properties of the phase.
#pragma once

#include <optional>

#include "phasetree/io/read_kind.hpp"

namespace phasetree::tracer {

// Properties written next to the material: "glass": {"clear": {…}, "density": 2500}.
struct PhaseParameters {
    static constexpr KindInfo info{"phase", "What an entry of \"phases\" may have besides its material."};

    std::optional<double> density{};

    template <class V>
    static void parameters(V&& v) {
        v(&PhaseParameters::density,
          Parameter{"density", "kg/m³", "Density, from which masses are computed. It does not affect rendering.",
                    Limits{.low = 0, .high = 1e12f}, true});
    }
};

struct PhaseEntry {
    // The member that is the material; nullopt if the entry has none, or if only read_material() can recognise it.
    std::optional<Value> material;
    bool has_parameters = false;
    PhaseParameters parameters;
};

// Throws SceneError if a parameter is wrong. Does not check the material.
PhaseEntry phase_entry(const Document&, Value entry);

// Whether the key is that of one of PhaseParameters.
bool is_phase_parameter(std::string_view key);

}  // namespace phasetree::tracer
