// Parameters that a scene file may give for a light of any kind, in addition to the kind's own parameters.
#pragma once

#include <algorithm>
#include <string>

#include "lights/lights.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

inline constexpr Parameter group_parameter{"group", "",
                                           "The group of lights that it is of: letters, digits, - and _. What the "
                                           "lights of a group bring is a plane of the picture.",
                                           limits::any, true};

/// Returns the name of a group, which becomes part of channel names. Throws ParameterError if it is invalid.
inline const std::string& checked_group(const std::string& group) {
    const auto is_allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    if (group.empty() || group.size() > 64 || !std::ranges::all_of(group, is_allowed))
        throw ParameterError("group", "\"group\" is made of 1 to 64 letters, digits, - and _");
    return group;
}

inline constexpr Parameter spectrum_parameter{
    "spectrum", "",
    "How its light is spread over the wavelengths, relative power at points or the temperature of what is hot. Of the "
    "light's own colour only the brightness counts then. Without \"spectral\" it is the colour of that spectrum.",
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
