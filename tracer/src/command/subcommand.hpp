// What is said of a command line that CLI11 does not accept.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "command/streams.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer {

// The option that a word such as "--sample" was meant to be; nothing if none is like it. Other renderers' names of some
// options are known.
inline std::optional<std::string> meant_option(const CLI::App& subcommand, std::string_view word) {
    static constexpr std::pair<std::string_view, std::string_view> others[] = {
        {"samples", "spp"}, {"sample", "spp"}, {"resolution", "size"}, {"width", "size"}, {"height", "size"}};
    std::vector<std::string> names;
    for (const CLI::Option* option : subcommand.get_options())
        names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
    word = word.substr(2, word.find('=') - 2);
    for (const auto& [other, name] : others)
        if (word == other && std::ranges::find(names, name) != names.end()) return std::string(name);
    return closest(word, names);
}

// Says of a word that is no option of the subcommand what may have been meant. False if that is not what is wrong.
inline bool explain_unknown_option(const CLI::App& app) {
    const std::vector<std::string> remaining = app.remaining(true);
    // CLI11 gives them from the last to the first.
    const auto word = std::ranges::find_if(remaining, [](const std::string& w) { return w.starts_with("--"); });
    if (word == remaining.end() || app.get_subcommands().empty()) return false;
    const CLI::App& subcommand = *app.get_subcommands().front();
    const std::optional<std::string> meant = meant_option(subcommand, *word);
    say("{} {}: there is no option {}{}\nRun with --help for those there are.\n", app.get_name(), subcommand.get_name(),
        word->substr(0, word->find('=')), meant ? fmt::format("; did you mean --{}?", *meant) : "");
    return true;
}

// Says what is wrong and returns the exit code: 2, or 0 if only help was asked for. CLI11 says of an unknown
// subcommand only that one is required; this names it, and the one that was meant or else all.
inline int exit_code(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> remaining = app.remaining();
    const bool is_unknown = dynamic_cast<const CLI::RequiredError*>(&error) && app.get_subcommands().empty() &&
                            !remaining.empty() && !remaining.front().starts_with('-');
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && explain_unknown_option(app)) return 2;
    if (!is_unknown) {
        std::ostringstream out, err;
        const bool is_help = app.exit(error, out, err) == 0;
        put(out.str());
        say(err.str());
        return is_help ? 0 : 2;
    }
    std::vector<std::string> names;
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(subcommand->get_name());
    const auto meant = closest(remaining.front(), names);
    say("{}: unknown subcommand \"{}\"; {}\n", app.get_name(), remaining.front(),
        meant ? fmt::format("did you mean \"{}\"?", *meant)
              : fmt::format("the subcommands are {}", fmt::join(names, ", ")));
    return 2;
}

}  // namespace phasetree::tracer
