// Where a camera stands and how it is turned: what all kinds of cameras have in common.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct ViewFrame {
    /// `up` need not be perpendicular to the axis; it is replaced by +y, or +x, when the camera looks along it. Throws
    /// std::invalid_argument for numbers that are not finite, and when the camera looks at the point where it is.
    ViewFrame(const glm::vec3& position, const glm::vec3& look_at, const glm::vec3& up);

    glm::dvec3 position;
    glm::dvec3 right, up, forward;  ///< orthonormal
    double distance;                ///< to the point that is examined
};

/// Half of a vertical field of view in degrees, in radians. Throws std::invalid_argument unless it is above 0 and below
/// 180 degrees.
double half_fov(float vertical_fov_degrees);

/// Throws std::invalid_argument unless there is at least one pixel.
void check_resolution(const glm::ivec2& resolution);

}  // namespace phasetree::tracer
