#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "phasetree/model/parameter.hpp"

namespace phasetree {

/// The numbers that a key accepts. `description` completes the sentence "… must be"; if it is empty, the bounds are
/// written out.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool min_is_open = false;  ///< min itself is excluded
    bool max_is_open = false;
    std::string_view description = {};  ///< must outlive the range; use a literal

    static constexpr Range any() { return {}; }
    static constexpr Range positive() { return {.min = 0, .min_is_open = true, .description = "positive"}; }
    static constexpr Range not_negative() { return {.min = 0, .description = "zero or more"}; }
    static constexpr Range at_least(double min) { return {.min = min}; }
    static constexpr Range above(double min) { return {.min = min, .min_is_open = true}; }
    static constexpr Range at_most(double max) { return {.max = max}; }
    static constexpr Range below(double max) { return {.max = max, .max_is_open = true}; }
    static constexpr Range between(double min, double max) { return {.min = min, .max = max}; }

    constexpr bool contains(double x) const {
        return (min_is_open ? x > min : x >= min) && (max_is_open ? x < max : x <= max);
    }
};

/// The numbers that a parameter accepts. Each limit is converted to double through the shortest decimal form of its
/// float. A file's 0.1 is therefore within limits that start at 0.1f, although that float is slightly larger.
Range range_of(const Limits&);

/// The text that completes "… must be": the range's own description, or its bounds.
std::string describe(const Range&);

}  // namespace phasetree
