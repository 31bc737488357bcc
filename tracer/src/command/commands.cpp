#include "command/commands.hpp"

#include <CLI/CLI.hpp>

namespace phasetree::tracer {

void add_commands(CLI::App& app, Run& run) {
    add_render(app, run);
    add_new(app, run);
    add_view(app, run);
    add_merge(app, run);
    add_farm(app, run);
    add_check(app, run);
    add_info(app, run);
    add_eval(app, run);
    add_trace(app, run);
    add_measure(app, run);
    add_solve(app, run);
    add_slice(app, run);
    add_nodes(app, run);
    add_export(app, run);
    add_import(app, run);
}

}  // namespace phasetree::tracer
