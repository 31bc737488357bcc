// Error messages for command lines that CLI11 rejects.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "command/exit_codes.hpp"
#include "command/streams.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer {

// The option that an unknown word such as "--sample" probably means; nullopt if none is similar. Knows names of some
// options in other renderers.
inline std::optional<std::string> meant_option(const CLI::App& subcommand, std::string_view word) {
    static constexpr std::pair<std::string_view, std::string_view> others[] = {
        {"samples", "spp"}, {"sample", "spp"}, {"resolution", "size"}, {"width", "size"}, {"height", "size"}};
    std::vector<std::string> names;
    for (const CLI::Option* option : subcommand.get_options())
        if (!option->get_group().empty())  // deprecated names are hidden
            names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
    word = word.substr(2, word.find('=') - 2);
    for (const auto& [other, name] : others)
        if (word == other && std::ranges::find(names, name) != names.end()) return std::string(name);
    return closest(word, names);
}

// Reports an unknown option, with a suggestion. Returns false if the error is something else.
inline bool explain_unknown_option(const CLI::App& app) {
    const std::vector<std::string> remaining = app.remaining(true);
    // CLI11 returns them in reverse order.
    const auto word = std::ranges::find_if(remaining, [](const std::string& w) { return w.starts_with("--"); });
    if (word == remaining.end() || app.get_subcommands().empty()) return false;
    const CLI::App& subcommand = *app.get_subcommands().front();
    const std::optional<std::string> meant = meant_option(subcommand, *word);
    say("{} {}: unknown option {}{}\nRun \"{} {} --help\" for a list of options.\n", app.get_name(),
        subcommand.get_name(), word->substr(0, word->find('=')),
        meant ? fmt::format(" (did you mean --{}?)", *meant) : "", app.get_name(), subcommand.get_name());
    return true;
}

// Reports the error and returns the exit code, which is success if only help was requested. For an unknown subcommand
// CLI11 only says that one is required. This names it and suggests the closest one, or lists all.
inline int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> remaining = app.remaining();
    const bool is_unknown = dynamic_cast<const CLI::RequiredError*>(&error) && app.get_subcommands().empty() &&
                            !remaining.empty() && !remaining.front().starts_with('-');
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && explain_unknown_option(app)) return exit_code::usage;
    if (!is_unknown) {
        std::ostringstream out, err;
        const bool is_help = app.exit(error, out, err) == 0;
        put(out.str());
        say(err.str());
        return is_help ? exit_code::success : exit_code::usage;
    }
    std::vector<std::string> names;
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    const auto meant = closest(remaining.front(), names);
    say("{}: unknown subcommand \"{}\" ({})\n", app.get_name(), remaining.front(),
        meant ? fmt::format("did you mean \"{}\"?", *meant) : fmt::format("choose from {}", fmt::join(names, ", ")));
    return exit_code::usage;
}

}  // namespace phasetree::tracer
