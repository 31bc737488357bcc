// The lat-long (equirectangular) parametrisation of directions, and the compass of the project.
//
// Up is +z; x points right and y away from the default viewer. Azimuths increase clockwise as seen from above, as on a
// compass with north = +y: azimuth 0 is +y, 90° is +x. The middle column of an image is azimuth 0, and its top row is
// the zenith. Columns increase with the azimuth, so that the right of the image is on the right for a viewer inside:
//     u = 1/2 + azimuth/2π,   v = θ/π,   θ = angle from +z.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

/// (u, v) in [0, 1]² of a direction of any length.
inline glm::vec2 lat_long_of(const glm::vec3& direction) {
    constexpr float half_turn = std::numbers::pi_v<float>;
    const float azimuth = portable::atan2(direction.x, direction.y);
    const float theta = portable::atan2(portable::hypot(direction.x, direction.y), direction.z);
    return {0.5f + azimuth / (2.0f * half_turn), theta / half_turn};
}

/// The unit direction of an azimuth (radians) and the cosine of the angle from +z.
inline glm::vec3 direction_of(double azimuth, double cos_theta) {
    const double sin_theta = std::sqrt(std::max(0.0, (1.0 - cos_theta) * (1.0 + cos_theta)));
    return {sin_theta * std::sin(azimuth), sin_theta * std::cos(azimuth), cos_theta};
}

/// The unit direction of an azimuth and an elevation above the horizon, both in degrees.
inline glm::vec3 direction_of_degrees(float azimuth, float elevation) {
    constexpr double radians = std::numbers::pi / 180.0;
    return direction_of(azimuth * radians, std::sin(elevation * radians));
}

}  // namespace phasetree::tracer
