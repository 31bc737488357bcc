// The reference of scene files: the library's nodes, and the path tracer's lists of parameters.
#pragma once

#include <string>

#include "phasetree/io/reference.hpp"

namespace phasetree::tracer {

std::vector<Chapter> scene_chapters();

// For a terminal, and as the page scenes/nodes.md.
std::string scene_reference_text();
std::string scene_reference_markdown();

// The JSON Schema of scene files, scenes/scene.schema.json.
std::string scene_json_schema();

}  // namespace phasetree::tracer
