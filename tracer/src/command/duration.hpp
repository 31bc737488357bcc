#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace phasetree::tracer {

/// Parses "90s", "5m", "1.5h" or a number of seconds. Returns nullopt for anything else, and for more than a year.
inline std::optional<double> seconds_of(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    if (error != std::errc()) return std::nullopt;
    const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
    const double seconds = number * factor;
    if (!(seconds > 0 && seconds <= 366.0 * 24 * 3600)) return std::nullopt;
    return seconds;
}

/// Adds an option whose value is a duration.
inline CLI::Option* add_duration(CLI::App& command, const std::string& name, double& seconds,
                                 const std::string& description) {
    const auto choose = [&seconds, name](const std::string& text) {
        const std::optional<double> time = seconds_of(text);
        if (!time)
            throw CLI::ValidationError(name, "must be a positive time such as 90s, 5m or 2h, but is \"" + text + "\"");
        seconds = *time;
    };
    return command.add_option_function<std::string>(name, choose, description)->option_text("TIME");
}

}  // namespace phasetree::tracer
