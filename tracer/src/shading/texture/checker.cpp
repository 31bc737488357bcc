#include "shading/texture/checker.hpp"

#include <cmath>

namespace phasetree::tracer {

glm::vec3 CheckerTexture::at(const glm::vec3& position) const {
    const glm::vec3 p = (position - origin) / size;
    // Half of the sum of the three cube numbers is an integer in the even cubes. Computed in floats, so that no
    // coordinate overflows an integer.
    const float half = 0.5f * (std::floor(p.x) + std::floor(p.y) + std::floor(p.z));
    return half == std::floor(half) ? even : odd;
}

}  // namespace phasetree::tracer
