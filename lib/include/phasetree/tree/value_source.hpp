#pragma once

#include <string_view>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A node on the path from an object to a primitive.
struct NodeOnPath {
    const void* node = nullptr;  ///< Field::node() or Phased::node() of its handle
    std::string_view name;       ///< as in scene files
};

/// Find the nodes that determine a component of Φ at a point: a path from the tree's root to one primitive.
///
/// At a minimum or maximum, the path follows the operand that is chosen; at a blend or a sum, the largest part. The
/// path is empty if no primitive determines the value, for example where the component is absent.
///
/// Slow: walks the tree like distances(). Throws ModelError if shared shapes expand to more nodes than can be walked
/// within seconds.
std::vector<NodeOnPath> value_source(const Phased&, const glm::vec3& p, Phase component);

}  // namespace phasetree
