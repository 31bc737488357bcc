// The position and orientation shared by all kinds of cameras.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct ViewFrame {
    /// `up` need not be perpendicular to the axis. It is replaced by +y, or +x, if the camera looks along it. Throws
    /// std::invalid_argument if numbers are not finite, or if `look_at` is the position.
    ViewFrame(const glm::vec3& position, const glm::vec3& look_at, const glm::vec3& up);

    glm::dvec3 position;
    glm::dvec3 right, up, forward;  ///< orthonormal
    double distance;                ///< from the position to `look_at`
};

/// Half of a vertical field of view given in degrees, in radians. Throws std::invalid_argument unless it is in (0,
/// 180).
double half_fov(float vertical_fov_degrees);

/// Throws std::invalid_argument unless there is at least one pixel.
void check_resolution(const glm::ivec2& resolution);

}  // namespace phasetree::tracer
