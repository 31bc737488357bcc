#pragma once

#include "math/dual.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tests {

/// Φ and its gradients by walking the tree with dual numbers: like phasetree::distances(), compiled once for all nodes.
Phases<Dual> dual_distances(const Phased&, const glm::vec3& p);

}  // namespace phasetree::tests
