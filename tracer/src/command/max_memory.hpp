#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace phasetree::tracer {

/// Parses "512M", "1.5G", "2 GiB" or a number of bytes; K, M and G are powers of 1024. Returns nullopt for anything
/// else.
inline std::optional<std::size_t> bytes_of(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    if (error != std::errc()) return std::nullopt;
    std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    if (unit.starts_with(' ')) unit.remove_prefix(1);
    double factor = 1;
    if (!unit.empty()) {
        const std::size_t power = std::string_view("KMGTkmgt").find(unit.front());
        if (power != std::string_view::npos) {
            for (std::size_t i = 0; i <= power % 4; ++i) factor *= 1024;
            unit.remove_prefix(1);
            if (unit.starts_with('i')) unit.remove_prefix(1);
        }
        if (unit != "" && unit != "B") return std::nullopt;
    }
    const double bytes = number * factor;
    if (!(bytes >= 1 && bytes < 0x1p62)) return std::nullopt;
    return static_cast<std::size_t>(bytes);
}

inline CLI::Option* add_max_memory(CLI::App& command, std::size_t& max_bytes) {
    const auto choose = [&max_bytes](const std::string& text) {
        const std::optional<std::size_t> bytes = bytes_of(text);
        if (!bytes)
            throw CLI::ValidationError("--max-memory", "must be a size such as 512M or 2G, but is \"" + text + "\"");
        max_bytes = *bytes;
    };
    return command
        .add_option_function<std::string>(
            "--max-memory", choose,
            "Memory limit for the prepared object, such as 512M or 4G. With less memory, tracing is slower (default: "
            "2G, or a quarter of the machine's memory if that is less)")
        ->option_text("SIZE");
}

}  // namespace phasetree::tracer
