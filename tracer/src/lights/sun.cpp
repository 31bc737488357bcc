#include "lights/sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "image/luminance.hpp"
#include "lights/check.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

Sun::Sun(const glm::vec3& direction, const glm::vec3& irradiance, float angular_diameter_degrees) {
    check_point(direction, "the sun's direction");
    check_colour(irradiance, "the sun's irradiance");
    check_positive(angular_diameter_degrees, "the sun's angular diameter");
    check_range(angular_diameter_degrees, 0.0f, 90.0f, "the sun's angular diameter in degrees");
    const glm::dvec3 towards(direction);
    if (!(glm::length(towards) > 0.0)) throw std::invalid_argument("the sun's direction must not be zero");
    direction_ = glm::normalize(towards);
    const double diameter = std::max(angular_diameter_degrees, least_angular_diameter_degrees);
    const double radius = 0.5 * diameter * std::numbers::pi / 180.0;
    // Of a direction's three coordinates, after a rotation of some roundings.
    constexpr double rounding = 2e-7;
    const double chord = 2.0 * std::sin(0.5 * radius) + rounding;
    squared_chord_ = static_cast<float>(chord * chord);
    cap_height_ = static_cast<float>(2.0 * std::sin(0.5 * radius) * std::sin(0.5 * radius));
    radiance_ = irradiance / static_cast<float>(std::numbers::pi * std::sin(radius) * std::sin(radius));
    if (!is_finite(radiance_)) throw std::invalid_argument("the sun's irradiance is too large");
}

bool Sun::in_disk(const glm::vec3& direction) const {
    // |ω − s|² = 2(1 − cos θ), which keeps its digits for small angles.
    const glm::vec3 chord = direction - direction_;
    return glm::dot(chord, chord) <= squared_chord_;
}

glm::vec3 Sun::radiance(const glm::vec3& direction) const {
    return in_disk(direction) ? radiance_ : glm::vec3(0.0f);
}

std::optional<DirectionSample> Sun::sample(const glm::vec2& u) const {
    const glm::vec3 sampled = glm::normalize(Frame(direction_).to_world(square_to_uniform_cone(u, cap_height_)));
    return DirectionSample{sampled, uniform_cone_pdf(cap_height_)};
}

float Sun::pdf(const glm::vec3& direction) const {
    return in_disk(direction) ? uniform_cone_pdf(cap_height_) : 0.0f;
}

float Sun::fluence() const {
    return luminance(radiance_) / uniform_cone_pdf(cap_height_);
}

}  // namespace phasetree::tracer
