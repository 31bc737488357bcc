#pragma once

#include <glm/vec3.hpp>

namespace phasetree {

/// A ray made ready once for all cells that it meets.
struct TracedRay {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};  ///< of unit length
    glm::dvec3 inverse{0};         ///< 1/direction, infinite where that is zero
    bool is_traceable = false;     ///< finite, and its direction of unit length to 10⁻³; no other hits anything

    TracedRay() = default;
    TracedRay(const glm::vec3& origin, const glm::vec3& direction);
};

}  // namespace phasetree
