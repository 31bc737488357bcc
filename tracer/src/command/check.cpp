#include <fmt/format.h>

#include <cstdio>

#include "command/commands.hpp"
#include "command/load.hpp"

namespace phasetree::tracer {

void add_check(CLI::App& app, Run& run) {
    CLI::App* command =
        app.add_subcommand("check", "Validate a scene file: silent and 0 if all is well, else the error and 2");
    auto file = std::make_shared<std::string>();
    command->add_option("scene", *file, "The scene file")->required();
    command->callback([file, &run] {
        run = [file] {
            (void)load_scene(*file);
            return 0;
        };
    });
}

}  // namespace phasetree::tracer
