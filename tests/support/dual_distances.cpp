#include "support/dual_distances.hpp"

#include "tree/walk.hpp"

namespace phasetree::tests {

Phases<Dual> dual_distances(const Phased& a, const glm::vec3& p) {
    return Walk<Dual>().phases(a, {Dual(p.x, 1, 0, 0), Dual(p.y, 0, 1, 0), Dual(p.z, 0, 0, 1)});
}

}  // namespace phasetree::tests
