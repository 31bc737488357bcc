#include "lights/sphere_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/luminance.hpp"
#include "lights/check.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

SphereLight::SphereLight(const glm::vec3& centre, float radius, const glm::vec3& radiance, bool visible_to_camera)
    : centre_(centre), radius_(radius), radiance_(radiance), visible_to_camera_(visible_to_camera) {
    check_point(centre, "the sphere light's centre");
    check_positive(radius, "the sphere light's radius");
    check_colour(radiance, "the sphere light's radiance");
}

// 1 − cos α of the cone that the sphere subtends; 2, all directions, from inside. With s = sin α, 1 − √(1 − s²) = s²/(1
// + √(1 − s²)) stays precise when the sphere is far away.
double SphereLight::cap_height(const glm::dvec3& to_centre) const {
    const double squared_distance = glm::dot(to_centre, to_centre);
    const double squared_radius = radius_ * radius_;
    if (!(squared_distance > squared_radius)) return 2.0;
    const double squared_sine = squared_radius / squared_distance;
    return squared_sine / (1.0 + std::sqrt(1.0 - squared_sine));
}

double SphereLight::solid_angle(const glm::vec3& p) const {
    return 2.0 * std::numbers::pi * cap_height(centre_ - glm::dvec3(p));
}

EmissionBounds SphereLight::emission_bounds() const {
    return {bounding_sphere(), static_cast<double>(luminance(radiance_)) * std::numbers::pi * radius_ * radius_, {}};
}

DirectionSample SphereLight::sample(const glm::vec3& p, const glm::vec2& u) const {
    const glm::dvec3 to_centre = centre_ - glm::dvec3(p);
    const double height = cap_height(to_centre);
    const auto pdf = static_cast<float>(1.0 / (2.0 * std::numbers::pi * height));
    if (height == 2.0) return {square_to_uniform_sphere(u), pdf};
    const glm::vec3 axis = glm::normalize(to_centre);
    return {glm::normalize(Frame(axis).to_world(square_to_uniform_cone(u, static_cast<float>(height)))), pdf};
}

float SphereLight::pdf_at(const glm::vec3& p, const glm::vec3&, float) const {
    return static_cast<float>(1.0 / solid_angle(p));
}

std::optional<float> SphereLight::intersect(const glm::vec3& origin, const glm::vec3& direction) const {
    const glm::dvec3 to_centre = centre_ - glm::dvec3(origin);
    const double squared_distance = glm::dot(to_centre, to_centre);
    const bool inside = !(squared_distance > radius_ * radius_);
    // Most rays miss by far. The direction, whose length is 1 up to rounding, is precise enough to detect that.
    const double roughly_along = glm::dot(to_centre, glm::dvec3(direction));
    const double far_reach = 1.001 * radius_ + 1e-5 * std::abs(roughly_along);
    if (!inside && squared_distance - (1 + 1e-5) * roughly_along * roughly_along > far_reach * far_reach)
        return std::nullopt;
    const glm::dvec3 d = glm::normalize(glm::dvec3(direction));
    const double along = glm::dot(to_centre, d);
    const glm::dvec3 across = to_centre - along * d;
    const double squared_half_chord = radius_ * radius_ - glm::dot(across, across);
    if (inside) return static_cast<float>(along + std::sqrt(std::max(0.0, squared_half_chord)));
    // The error of a unit direction whose coordinates were rounded several times by a change of frame.
    constexpr double rounding = 2e-7;
    const double reach = radius_ + rounding * along;
    if (!(glm::dot(across, across) <= reach * reach) || !(along > 0.0)) return std::nullopt;
    return static_cast<float>(along - std::sqrt(std::max(0.0, squared_half_chord)));
}

SurfacePoint SphereLight::surface_point(const glm::vec2& u) const {
    const glm::vec3 normal = square_to_uniform_sphere(u);
    return {glm::vec3(centre_ + radius_ * glm::dvec3(normal)), normal};
}

glm::vec3 SphereLight::normal_at(const glm::vec3& point) const {
    return glm::vec3(glm::normalize(glm::dvec3(point) - centre_));
}

float SphereLight::area() const {
    return static_cast<float>(4.0 * std::numbers::pi * radius_ * radius_);
}

}  // namespace phasetree::tracer
