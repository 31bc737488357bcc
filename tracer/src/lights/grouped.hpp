// Parameters that a scene file may give for a light of any kind, in addition to the kind's own parameters.
#pragma once

#include <algorithm>
#include <string>

#include "lights/lights.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

inline constexpr Parameter group_parameter{
    "group", "", "Light group, of letters, digits, - and _. The light of each group is written to a plane of its own.",
    limits::any, true};

/// Returns the name of a group, which becomes part of channel names. Throws ParameterError if it is invalid.
inline const std::string& checked_group(const std::string& group) {
    const auto is_allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    if (group.empty() || group.size() > 64 || !std::ranges::all_of(group, is_allowed))
        throw ParameterError("group", "\"group\" must have 1 to 64 letters, digits, - and _");
    return group;
}

inline constexpr Parameter spectrum_parameter{
    "spectrum", "",
    "Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, "
    "only the brightness of the light's colour is used. Without \"spectral\", the light has the colour of this "
    "spectrum.",
    limits::any, true};

template <class Kind>
struct Grouped : Kind {
    std::string group{default_group};
    SharedLightSpectrum spectrum{};

    template <class V>
    static void parameters(V&& v) {
        Kind::parameters(v);
        v(&Grouped::group, group_parameter);
        v(&Grouped::spectrum, spectrum_parameter);
    }

    /// Returns the name of the group. Throws ParameterError if it is invalid.
    const std::string& checked_group() const { return tracer::checked_group(group); }
};

}  // namespace phasetree::tracer
