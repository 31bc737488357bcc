#include "camera/view_frame.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

namespace phasetree::tracer {

namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 right_of(const glm::dvec3& forward, const glm::vec3& up) {
    for (const glm::dvec3& candidate : {glm::dvec3(up), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(1.0, 0.0, 0.0)}) {
        const double length = glm::length(candidate);
        const glm::dvec3 right = glm::cross(forward, candidate);
        if (glm::length(right) > 1e-6 * length) return glm::normalize(right);
    }
    return {1.0, 0.0, 0.0};
}

}  // namespace

ViewFrame::ViewFrame(const glm::vec3& from, const glm::vec3& look_at, const glm::vec3& wanted_up) : position(from) {
    if (!finite(from)) throw std::invalid_argument("the camera's position must be three finite numbers");
    if (!finite(look_at)) throw std::invalid_argument("the point the camera looks at must be three finite numbers");
    if (!finite(wanted_up)) throw std::invalid_argument("the camera's up direction must be three finite numbers");
    const glm::dvec3 axis = glm::dvec3(look_at) - position;
    distance = glm::length(axis);
    if (!(distance > 0.0)) throw std::invalid_argument("the camera's position and the point it looks at are the same");
    forward = axis / distance;
    right = right_of(forward, wanted_up);
    up = glm::cross(right, forward);
}

double half_fov(float vertical_fov_degrees) {
    if (!(vertical_fov_degrees > 0.0f) || !(vertical_fov_degrees < 180.0f)) {
        throw std::invalid_argument("the camera's vertical field of view must be between 0 and 180 degrees");
    }
    return 0.5 * static_cast<double>(vertical_fov_degrees) * std::numbers::pi / 180.0;
}

void check_resolution(const glm::ivec2& resolution) {
    if (resolution.x < 1 || resolution.y < 1) throw std::invalid_argument("the image must have at least one pixel");
}

}  // namespace phasetree::tracer
