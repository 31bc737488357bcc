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

/// What is known of a ray that starts (t_min = 0) at p_in or p_out of a crossing that was found in the very cell which
/// is asked, and carries the phase there: mostly that it does not come back, so that looking costs nothing.
struct LeavingHint {
    /// How fast the distance from the interface grows along the ray, as far as it is known: 0 if it is not.
    float rise = 0;
};

}  // namespace phasetree
