// What a scene file may say of a light of any kind, beside the kind's own parameters.
#pragma once

#include <algorithm>
#include <string>

#include "lights/lights.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

template <class Kind>
struct Grouped : Kind {
    std::string group{default_group};

    template <class V>
    static void parameters(V&& v) {
        Kind::parameters(v);
        v(&Grouped::group, Parameter{"group", "",
                                     "The group of lights that it is of: letters, digits, - and _. What the lights of "
                                     "a group bring is a plane of the picture.",
                                     limits::any, true});
    }

    /// The group's name, which is a part of channels' names. Throws ParameterError for one that cannot be.
    const std::string& checked_group() const {
        const auto is_allowed = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
        };
        if (group.empty() || group.size() > 64 || !std::ranges::all_of(group, is_allowed))
            throw ParameterError("group", "\"group\" is made of 1 to 64 letters, digits, - and _");
        return group;
    }
};

}  // namespace phasetree::tracer
