#pragma once

#include <span>
#include <string>

#include "phasetree/io/tree.hpp"

namespace phasetree {

/// Write a tree as the text of a scene file. read_tree() returns an identical tree, to the last bit.
///
/// Subtrees that are used more than once become named shapes. Each phase gets a grey material. There is no camera and
/// no light; add them to render the scene. Throws ModelError if a node has file content, such as a mesh or an image,
/// that was not read from a file, and std::out_of_range if the tree has phases without a name.
std::string write_tree(const SceneTree&);

/// The same with the given materials: a JSON text for each phase but the vacuum.
std::string write_tree(const SceneTree&, std::span<const std::string> materials);

/// The same with null as the material of each phase. The result can only be read as a tree again.
std::string write_tree_without_materials(const SceneTree&);

}  // namespace phasetree
