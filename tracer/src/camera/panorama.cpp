#include "camera/panorama.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace phasetree::tracer {

Panorama::Panorama(const PanoramaParameters& p, const glm::ivec2& resolution)
    : frame_(p.position, p.look_at, p.up), resolution_(resolution) {
    check_resolution(resolution);
}

CameraRay Panorama::generate(const glm::dvec2& film, const glm::vec2&) const {
    // Beyond an edge, the angles continue around the sphere.
    const double azimuth = 2.0 * std::numbers::pi * (film.x / resolution_.x - 0.5);
    const double elevation = std::numbers::pi * (0.5 - film.y / resolution_.y);
    const glm::dvec3 level = std::sin(azimuth) * frame_.right + std::cos(azimuth) * frame_.forward;
    return {frame_.position, glm::normalize(std::cos(elevation) * level + std::sin(elevation) * frame_.up)};
}

}  // namespace phasetree::tracer
