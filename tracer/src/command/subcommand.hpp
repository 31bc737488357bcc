// What is said of a command line that CLI11 does not accept.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "command/streams.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree::tracer {

// Says what is wrong and returns the exit code: 2, or 0 if only help was asked for. CLI11 says of an unknown
// subcommand only that one is required; this names it, and the one that was meant or else all.
inline int exit_code(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> remaining = app.remaining();
    const bool is_unknown = dynamic_cast<const CLI::RequiredError*>(&error) && app.get_subcommands().empty() &&
                            !remaining.empty() && !remaining.front().starts_with('-');
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
