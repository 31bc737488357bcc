#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace phasetree::tracer {

/// A validator for CLI11 that accepts numbers from `low` to `high`. Use it instead of CLI::Range, which also accepts
/// NaN.
inline CLI::Validator number_in(double low, double high) {
    const auto problem = [=](const std::string& text) {
        double number = 0;
        const bool is_right = CLI::detail::lexical_cast(text, number) && number >= low && number <= high;
        return is_right ? std::string() : fmt::format("must be a number from {} to {}, but is \"{}\"", low, high, text);
    };
    return {problem, CLI::Range(low, high).get_description()};
}

}  // namespace phasetree::tracer
