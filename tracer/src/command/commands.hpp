// The subcommands of `phasetree`, one file each. Each adds itself to the command line and, when it is chosen, sets
// `run`, which returns the exit code: 0 for success, 1 for a run that failed, 2 for input that is wrong, 3 of `check`
// for a scene that is only a tree; of an interrupted run as below.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace phasetree::tracer {

using Run = std::function<int()>;

inline constexpr int only_a_tree = 3;
// Of a run that SIGTERM or SIGHUP ended (1 if nothing is there to go on from), and one that Ctrl-C ended. The first is
// EX_TEMPFAIL of sysexits.h, by which batch systems know that a job may be tried again; the second is what shells say
// of a program that SIGINT ended.
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

// All of them, in the order of the help.
void add_commands(CLI::App& app, Run& run);

}  // namespace phasetree::tracer
