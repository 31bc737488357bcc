#include "camera/orthographic.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace phasetree::tracer {

Orthographic::Orthographic(const OrthographicParameters& p, const glm::ivec2& resolution)
    : frame_(p.position, p.look_at, p.up), centre_(0.5 * glm::dvec2(resolution)) {
    check_resolution(resolution);
    if (!std::isfinite(p.height) || !(p.height > 0.0f))
        throw std::invalid_argument("the height that the camera shows must be a positive number");
    pixel_size_ = static_cast<double>(p.height) / resolution.y;
}

CameraRay Orthographic::generate(const glm::dvec2& film, const glm::vec2&) const {
    const double right = (film.x - centre_.x) * pixel_size_;
    const double up = (centre_.y - film.y) * pixel_size_;
    return {frame_.position + right * frame_.right + up * frame_.up, glm::normalize(glm::vec3(frame_.forward))};
}

}  // namespace phasetree::tracer
