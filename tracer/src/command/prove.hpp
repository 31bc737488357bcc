// `check --prove`.
#pragma once

#include <optional>
#include <string>

#include "command/scene_file.hpp"

namespace CLI {
class App;
}

namespace phasetree::tracer {

struct ProveCommand {
    bool is_wanted = false;
    std::optional<std::string> object;
    double resolution = 0;
    double seconds = 60;
    bool as_json = false;
};

// Adds --prove and its options.
void add_prove_options(CLI::App& command, ProveCommand&);

// Proves or refutes what the scene expects, or reports what is known of its phases if it expects nothing. Returns the
// exit code.
int prove_scene(const SceneFile&, const ProveCommand&);

}  // namespace phasetree::tracer
