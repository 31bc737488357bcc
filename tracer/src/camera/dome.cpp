#include "camera/dome.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

namespace phasetree::tracer {

Dome::Dome(const DomeParameters& p, const glm::ivec2& resolution)
    : frame_(p.position, p.look_at, p.up), centre_(0.5 * glm::dvec2(resolution)) {
    check_resolution(resolution);
    if (!(p.fov_degrees > 0.0f) || !(p.fov_degrees <= 360.0f))
        throw std::invalid_argument("the dome's field of view must be above 0 and at most 360 degrees");
    pixel_angle_ = static_cast<double>(p.fov_degrees) * std::numbers::pi / 180.0 / std::min(resolution.x, resolution.y);
}

CameraRay Dome::generate(const glm::dvec2& film, const glm::vec2&) const {
    const glm::dvec2 out(film.x - centre_.x, centre_.y - film.y);
    const double radius = glm::length(out);
    const double angle = std::min(radius * pixel_angle_, std::numbers::pi);
    const glm::dvec2 across = radius > 0.0 ? out / radius : glm::dvec2(0.0);
    const glm::dvec3 sideways = across.x * frame_.right + across.y * frame_.up;
    return {frame_.position, glm::normalize(std::cos(angle) * frame_.forward + std::sin(angle) * sideways)};
}

}  // namespace phasetree::tracer
