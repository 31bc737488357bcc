#pragma once

#include <span>
#include <string>

#include "phasetree/io/tree.hpp"

namespace phasetree {

/// A scene file's text with this tree: read_tree() of it gives an equal one, to the last bit. Subtrees used more than
/// once become named shapes. The phases get a grey material each, and there is no camera and no light: add them to
/// render it. Throws ModelError if a node holds a network or an image that was not read from a file, and
/// std::out_of_range if the tree has phases without a name.
std::string write_tree(const SceneTree&);

/// The same with these materials, a JSON text for each phase but the vacuum.
std::string write_tree(const SceneTree&, std::span<const std::string> materials);

/// The same with null for each phase's material: a text to read the tree from again, and nothing else.
std::string write_tree_without_materials(const SceneTree&);

}  // namespace phasetree
