#pragma once

#include <glm/vec3.hpp>

namespace phasetree {

/// A ray with what is computed once for all cells that it meets.
struct TracedRay {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, 1};  ///< of unit length
    glm::dvec3 inverse{0};         ///< 1/direction, infinite along an axis where that is 0
    /// Whether all is finite, and the direction of unit length to 10⁻³; a ray that is not traceable hits nothing.
    bool is_traceable = false;

    TracedRay() = default;
    TracedRay(const glm::vec3& origin, const glm::vec3& direction);
};

/// A hint for a ray that starts (t_min = 0) at p_in or p_out of a crossing and carries the phase there, when the cell
/// that found this crossing is asked again. Mostly the hint is enough to tell that the ray leaves the cell without
/// meeting another interface.
struct LeavingHint {
    /// The derivative of the distance from the interface along the ray, in [−1, 1]; 0 if it is not known. A value near
    /// 0 or below it means only that the ray starts on an interface of this cell.
    float rise = 0;
};

}  // namespace phasetree
