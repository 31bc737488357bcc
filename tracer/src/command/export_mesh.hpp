// `export` to files of triangles.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command/scene_file.hpp"

namespace phasetree::tracer {

struct MeshExport {
    std::string output;
    float spacing = 0;                // of the grid, in the scene's unit; 0 chooses one
    float scale = 1;                  // by which what is written is larger than the scene
    std::vector<std::string> phases;  // by name; all but the vacuum if there is none
    std::optional<std::string> object;
    std::size_t most_bytes = 0;  // that the prepared object may take; 0 for the default
};

// Whether a file with this extension is one of triangles.
bool is_mesh_extension(std::string_view extension);

// Returns the exit code.
int export_mesh(const SceneFile&, const MeshExport&);

}  // namespace phasetree::tracer
