// `export` to triangle files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command/scene_file.hpp"

namespace phasetree::tracer {

struct MeshExport {
    std::string output;
    float spacing = 0;                // grid spacing in scene units; 0 for automatic
    std::optional<float> scale;       // written lengths per scene length; by default, see export_mesh()
    std::vector<std::string> phases;  // names of the phases to export; empty for all but the vacuum
    std::optional<std::string> object;
    std::size_t max_bytes = 0;  // memory limit of the prepared object; 0 for the default
};

// Whether files with this extension contain triangles.
bool is_mesh_extension(std::string_view extension);

// Returns the exit code. If the scene declares its unit, lengths in .3mf and .glb files are converted to the units of
// these formats, unless a scale is given.
int export_mesh(const SceneFile&, const MeshExport&);

}  // namespace phasetree::tracer
