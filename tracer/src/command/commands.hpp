// The subcommands of `phasetree`, one file each. Each registers itself on the command line and, when selected, sets
// `run`, which returns the exit code (exit_codes.hpp).
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace phasetree::tracer {

using Run = std::function<int()>;

void add_render(CLI::App& app, Run& run);
void add_new(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);
void add_merge(CLI::App& app, Run& run);
void add_farm(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_eval(CLI::App& app, Run& run);
void add_trace(CLI::App& app, Run& run);
void add_measure(CLI::App& app, Run& run);
void add_solve(CLI::App& app, Run& run);
void add_slice(CLI::App& app, Run& run);
void add_nodes(CLI::App& app, Run& run);
void add_export(CLI::App& app, Run& run);
void add_import(CLI::App& app, Run& run);

// Adds all subcommands, in the order of the help.
void add_commands(CLI::App& app, Run& run);

}  // namespace phasetree::tracer
