// The subcommands of `phasetree`, one file each. Each registers itself on the command line and, when selected, sets
// `run`, which returns the exit code: 0 for success, 1 for failure, 2 for invalid input, and 3 from `check` for a scene
// that is only a tree. For interrupted runs see below.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace phasetree::tracer {

using Run = std::function<int()>;

inline constexpr int only_a_tree = 3;
// Exit codes of a run ended by SIGTERM or SIGHUP (1 if there is nothing to resume from), and by Ctrl-C. The first is
// EX_TEMPFAIL of sysexits.h, by which batch systems recognise that the job may be retried. The second is what shells
// report for a program ended by SIGINT.
inline constexpr int resume_me = 75, interrupted_by_person = 130;

void add_render(CLI::App& app, Run& run);
void add_view(CLI::App& app, Run& run);
void add_merge(CLI::App& app, Run& run);
void add_farm(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_eval(CLI::App& app, Run& run);
void add_trace(CLI::App& app, Run& run);
void add_nodes(CLI::App& app, Run& run);
void add_export(CLI::App& app, Run& run);

// Adds all subcommands, in the order of the help.
void add_commands(CLI::App& app, Run& run);

}  // namespace phasetree::tracer
