#pragma once

#include <limits>
#include <string_view>

namespace phasetree {

/// The numbers a key accepts. `description` finishes the sentence "… must be"; without one the bounds are spelt out.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool min_is_open = false;  ///< min itself is outside
    bool max_is_open = false;
    std::string_view description = {};  ///< must outlive the range: use a literal

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

}  // namespace phasetree
