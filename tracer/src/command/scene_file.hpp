// The scene that a subcommand reads, and where it may read files from.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "phasetree/io/document.hpp"

namespace CLI {
class App;
}

namespace phasetree::tracer {

struct SceneFile {
    std::string name;
    std::optional<std::string> assets_within;
    std::optional<double> at;  // the time at which to read the scene, in seconds

    // The scene's name in errors and in files made from it.
    std::string shown() const { return is_standard_input() ? "<stdin>" : name; }
    // "-", and the system's names for it.
    bool is_standard_input() const { return name == "-" || name == "/dev/stdin" || name == "/dev/fd/0"; }
};

// Adds the argument SCENE and the options --assets-within and --at.
std::shared_ptr<SceneFile> add_scene_file(CLI::App& command);

// Adds the option --object, which selects one of several objects by name.
void add_object(CLI::App& command, std::optional<std::string>& object);

// Throws SceneError.
Document read_document(const SceneFile&);

}  // namespace phasetree::tracer
