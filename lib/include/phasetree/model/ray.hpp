#pragma once

#include <glm/vec3.hpp>

namespace phasetree {

/// A ray, with values computed once for all cells that it meets.
struct TracedRay {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};  ///< of unit length
    glm::dvec3 inverse{0};         ///< 1/direction; infinite along an axis where the direction is 0
    /// Whether the origin is finite and the squared length of the direction is within 10⁻³ of 1. A ray that is not
    /// traceable hits nothing.
    bool is_traceable = false;

    TracedRay() = default;
    TracedRay(const glm::vec3& origin, const glm::vec3& direction);
};

/// A hint for a ray that starts (t_min = 0) at p_from or p_to of a crossing and carries the phase of that point. Pass
/// it only to the cell that found the crossing. Usually the hint suffices to prove that the ray leaves the cell without
/// meeting another interface.
struct LeavingHint {
    /// The derivative of the distance from the interface along the ray, in [−1, 1]; 0 if unknown. A value near or below
    /// 0 says only that the ray starts on an interface of this cell.
    float rise = 0;
};

}  // namespace phasetree
