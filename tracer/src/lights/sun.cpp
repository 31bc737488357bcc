#include "lights/sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "image/luminance.hpp"
#include "lights/check.hpp"

namespace phasetree::tracer {

namespace {

glm::vec3 unit(const glm::vec3& direction) {
    check_point(direction, "the sun's direction");
    const glm::dvec3 towards(direction);
    if (!(glm::length(towards) > 0.0)) throw std::invalid_argument("the sun's direction must not be zero");
    return glm::normalize(towards);
}

// In radians, from the centre of the disk to its rim.
double radius(float angular_diameter_degrees) {
    check_positive(angular_diameter_degrees, "the sun's angular diameter");
    check_range(angular_diameter_degrees, 0.0f, 90.0f, "the sun's angular diameter in degrees");
    const double diameter = std::max(angular_diameter_degrees, Sun::least_angular_diameter_degrees);
    return 0.5 * diameter * std::numbers::pi / 180.0;
}

}  // namespace

Sun::Sun(const glm::vec3& direction, const glm::vec3& irradiance, float angular_diameter_degrees)
    : disk_(unit(direction), radius(angular_diameter_degrees)) {
    check_colour(irradiance, "the sun's irradiance");
    const double sine = std::sin(radius(angular_diameter_degrees));
    radiance_ = irradiance / static_cast<float>(std::numbers::pi * sine * sine);
    if (!is_finite(radiance_)) throw std::invalid_argument("the sun's irradiance is too large");
}

glm::vec3 Sun::radiance(const glm::vec3& direction) const {
    return disk_.contains(direction) ? radiance_ : glm::vec3(0.0f);
}

std::optional<DirectionSample> Sun::sample(const glm::vec2& u) const {
    return DirectionSample{disk_.sample(u), 1.0f / disk_.solid_angle()};
}

float Sun::pdf(const glm::vec3& direction) const {
    return disk_.pdf(direction);
}

float Sun::fluence() const {
    return luminance(radiance_) * disk_.solid_angle();
}

}  // namespace phasetree::tracer
