// The subcommands of `phasetree`, one file each. Each adds itself to the command line and, when it is chosen, sets
// `run`, which returns the exit code: 0 for success, 1 for an interrupted or failed run, 2 for input that is wrong, 3
// of `check` for a scene that is only a tree.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace phasetree::tracer {

using Run = std::function<int()>;

inline constexpr int only_a_tree = 3;

void add_render(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_eval(CLI::App& app, Run& run);
void add_trace(CLI::App& app, Run& run);
void add_nodes(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);

// All of them, in the order of the help.
void add_commands(CLI::App& app, Run& run);

}  // namespace phasetree::tracer
