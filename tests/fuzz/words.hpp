// The words that a scene file may hold: names of nodes and of their parameters.
#pragma once

#include <string>
#include <vector>

namespace phasetree::fuzz {

// From the JSON Schema of scene files, which is made from the list of nodes; each word once.
std::vector<std::string> words();

}  // namespace phasetree::fuzz
