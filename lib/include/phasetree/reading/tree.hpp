#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "phasetree/model/handle.hpp"
#include "phasetree/reading/document.hpp"

namespace phasetree {

/// The names that a scene file gives to its phases, in the order of the file: names[0] is "vacuum".
struct PhaseNames {
    std::vector<std::string> names{"vacuum"};

    const std::string& operator[](Phase p) const { return names[p.index]; }
    /// Material phases, the vacuum not counted.
    std::size_t size() const { return names.size() - 1; }
};

/// What of a scene file is the model: the names of "phases", the named "shapes", and the "tree".
struct SceneTree {
    PhaseNames phases;
    Phased object;
};

/// Reads the model of a scene document; the rest of the file is not looked at.
///
///     "phases": {"glass": …, "water": …},
///     "shapes": {"bulb": {"sphere": {"radius": 1}}},
///     "tree":   {"under": [{"set": {"phase": "glass", "of": "bulb"}}, …]}
///
/// A node is an object of one member: the node's name, and its parameters; a node whose one required parameter is a
/// list of children takes the list in place of the parameters. A string is a named shape. Names of phases are
/// strings, sets of phases lists of them. Throws SceneError, at the place in the text.
SceneTree read_tree(const Document&);

}  // namespace phasetree
