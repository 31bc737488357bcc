#include <cmath>

#include "phasetree/nodes/copies/placed.hpp"
#include "phasetree_support/orthonormal_basis.hpp"

namespace phasetree {

Placement Placement::standing(const glm::vec3& by, const glm::dvec3& normal, double turn, float scale) {
    Placement result = at(by, 0, scale);
    const support::OrthonormalBasis<glm::dvec3> basis(normal);
    const glm::dvec3 &u = basis.tangent, &v = basis.bitangent;
    const double c = std::cos(glm::radians(turn)), s = std::sin(glm::radians(turn));
    result.frame = glm::mat3(glm::dmat3(u * c + v * s, v * c - u * s, normal));
    return result;
}

}  // namespace phasetree
