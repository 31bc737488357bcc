#pragma once

#include <string_view>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A node on the way from an object to a primitive.
struct NodeOnPath {
    const void* node = nullptr;  ///< Field::node() or Phased::node() of its handle
    std::string_view name;       ///< as scene files name it
};

/// Which nodes give a component of Φ its value at a point: from the tree's root down to one primitive. Where minimum
/// and maximum choose, it is the operand that they choose; where a blend or a sum has several parts, it is the largest
/// one. The path is empty if no primitive does, as where the component is absent.
///
/// The tree is walked as by distances(), which is slow. Throws ModelError for a tree in which shared shapes stand for
/// more nodes than can be walked within seconds.
std::vector<NodeOnPath> value_source(const Phased&, const glm::vec3& p, Phase component);

}  // namespace phasetree
