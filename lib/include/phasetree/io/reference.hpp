#pragma once

#include <string>

namespace phasetree {

/// Every node with its parameters, units, limits, defaults, equation and section of the paper, from the nodes' own
/// definitions: as text for a terminal, and as a page in Markdown.
std::string node_reference_text();
std::string node_reference_markdown();

/// A JSON Schema (draft 7) of scene files, with which an editor completes and checks them. Nodes are described whole;
/// of the other parts the keys and kinds.
std::string scene_json_schema();

}  // namespace phasetree
