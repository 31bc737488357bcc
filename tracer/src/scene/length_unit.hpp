// The units of lengths, volumes and masses: one list of each, which determines the names in scene files, in options and
// in the schema.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace phasetree::tracer {

struct LengthUnit {
    std::string_view name;
    double metres = 1;
};

inline constexpr std::array length_units{LengthUnit{"mm", 1e-3}, LengthUnit{"cm", 1e-2}, LengthUnit{"m", 1},
                                         LengthUnit{"in", 0.0254}};

struct NamedUnit {
    std::string_view name;
    double size;  // in m³ or kg
};

inline constexpr std::array volume_units{NamedUnit{"mm3", 1e-9}, NamedUnit{"ml", 1e-6}, NamedUnit{"cm3", 1e-6},
                                         NamedUnit{"cl", 1e-5},  NamedUnit{"dl", 1e-4}, NamedUnit{"l", 1e-3},
                                         NamedUnit{"dm3", 1e-3}, NamedUnit{"m3", 1}};
inline constexpr std::array mass_units{NamedUnit{"mg", 1e-6}, NamedUnit{"g", 1e-3}, NamedUnit{"kg", 1},
                                       NamedUnit{"t", 1e3}};

// "mm, cm, m or in", with quotation marks if wanted.
inline std::string names_of_length_units(std::string_view quote = "") {
    std::string names;
    for (std::size_t i = 0; i < length_units.size(); ++i) {
        names += i == 0 ? "" : i + 1 == length_units.size() ? " or " : ", ";
        names += std::string(quote) + std::string(length_units[i].name) + std::string(quote);
    }
    return names;
}

inline std::optional<LengthUnit> length_unit_named(std::string_view name) {
    const auto found = std::ranges::find(length_units, name, &LengthUnit::name);
    return found == length_units.end() ? std::nullopt : std::optional(*found);
}

}  // namespace phasetree::tracer
