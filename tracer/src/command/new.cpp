#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command/commands.hpp"
#include "command/errors.hpp"
#include "command/streams.hpp"
#include "output/file.hpp"
#include "phasetree/io/suggest.hpp"
#include "studio/starts.hpp"

namespace phasetree::tracer {

namespace {

struct NewOptions {
    std::string start, output;
    bool replaces = false;
};

const studio::StartFile& start_named(const std::string& name) {
    std::vector<std::string_view> names;
    for (const studio::StartFile& file : studio::start_files()) {
        if (file.stem() == name) return file;
        names.push_back(file.stem());
    }
    const auto meant = closest(name, std::span<const std::string_view>(names));
    throw UsageError(
        fmt::format("new: there is no scene \"{}\" to start from ({})", name,
                    meant ? fmt::format("did you mean \"{}\"?", *meant) : "\"phasetree new --help\" lists them"));
}

int write_start(const NewOptions& options) {
    const studio::StartFile& start = start_named(options.start);
    const std::filesystem::path file = options.output.empty() ? std::string(start.name) : options.output;
    std::error_code ignored;
    const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
    if (is_there && !options.replaces)
        throw UsageError(fmt::format(
            "new: {} exists already; choose another name with -o, or replace the file with --force", file.string()));
    write_file(start.text, file);
    say("phasetree: wrote {}; edit it with \"phasetree view {} --open\"\n", file.string(), file.string());
    return 0;
}

std::string list_of_starts() {
    std::string text = "Scenes to start from:\n";
    for (const studio::StartFile& file : studio::start_files())
        text += fmt::format("  {:<8} {}\n", file.stem(), file.summary());
    return text;
}

}  // namespace

void add_new(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("new", "Write a scene to start from");
    command->footer(list_of_starts());
    auto o = std::make_shared<NewOptions>();
    command->add_option("NAME", o->start, "The scene to start from, such as glass or empty")->required();
    command->add_option("-o,--output", o->output, "The new file (default: NAME.json)")->option_text("FILE");
    command->add_flag("--force", o->replaces, "Replace the file if it exists");
    command->callback([o, &run] { run = [o] { return write_start(*o); }; });
}

}  // namespace phasetree::tracer
