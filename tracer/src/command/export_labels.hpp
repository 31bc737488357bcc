// `export` to grids of labels.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "command/scene_file.hpp"

namespace phasetree::tracer {

struct LabelExport {
    std::string output;
    float spacing = 0;                  // between voxels in scene units; 0 for automatic
    std::optional<float> scale;         // written lengths per scene length
    std::optional<std::string> object;  // of a scene with several
    std::size_t max_bytes = 0;          // memory limit; 0 for the default
};

// Whether files with this extension contain voxels.
bool is_label_extension(std::string_view extension);

// Returns the exit code.
int export_labels(const SceneFile&, const LabelExport&);

}  // namespace phasetree::tracer
