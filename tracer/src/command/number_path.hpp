// A number in a scene file, and the bracket in which to look for its value.
#pragma once

#include <optional>
#include <string>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

struct NumberToSet {
    std::string pointer;                  // its JSON pointer (RFC 6901), such as "/tree/set/of/sphere/radius"
    double low = 0, high = 0;             // the bracket
    std::optional<double> key_seconds{};  // if it is part of the value of a keyframe: the time of that keyframe
    bool is_time_of_key = false;
};

// Parses PATH or PATH=LOW:HIGH. Without a bracket, it is from half to twice the number in the file. Throws UsageError
// that begins with "--set: ".
NumberToSet number_to_set(const std::string& text, const Document& document);

}  // namespace phasetree::tracer
