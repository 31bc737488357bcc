#include "camera/tilt_shift.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

TiltShift::TiltShift(const TiltShiftParameters& p, const glm::ivec2& resolution)
    : frame_(p.position, p.look_at, p.up), aperture_(p) {
    check_resolution(resolution);
    if (p.focus_distance && !(std::isfinite(*p.focus_distance) && *p.focus_distance > 0.0f))
        throw std::invalid_argument("the camera's focus distance must be a positive number");
    if (!std::isfinite(p.shift.x) || !std::isfinite(p.shift.y))
        throw std::invalid_argument("the camera's shift must be two finite numbers");
    const auto leans = [](float degrees) { return std::abs(degrees) < 90.0f; };
    if (!leans(p.tilt.x) || !leans(p.tilt.y))
        throw std::invalid_argument("the camera's tilt must be between -90 and 90 degrees");
    pixel_size_ = portable::tan(half_fov(p.vertical_fov_degrees)) / (0.5 * resolution.y);
    middle_ = 0.5 * glm::dvec2(resolution) +
              glm::dvec2(-static_cast<double>(p.shift.x), static_cast<double>(p.shift.y)) * double(resolution.y);
    const glm::dvec2 slope(portable::tan(static_cast<double>(p.tilt.x) * std::numbers::pi / 180.0),
                           portable::tan(static_cast<double>(p.tilt.y) * std::numbers::pi / 180.0));
    focus_normal_ = glm::normalize(frame_.forward - slope.x * frame_.up - slope.y * frame_.right);
    const double distance = p.focus_distance ? static_cast<double>(*p.focus_distance) : frame_.distance;
    focus_reach_ = distance * glm::dot(frame_.forward, focus_normal_);
}

CameraRay TiltShift::generate(const glm::dvec2& film, const glm::vec2& lens_sample) const {
    const double x = (film.x - middle_.x) * pixel_size_;
    const double y = (middle_.y - film.y) * pixel_size_;
    const glm::dvec3 through_centre = x * frame_.right + y * frame_.up + frame_.forward;
    if (aperture_.is_pinhole()) return {frame_.position, glm::normalize(through_centre)};
    const glm::dvec2 lens = aperture_.sample(lens_sample);
    const glm::dvec3 on_lens = lens.x * frame_.right + lens.y * frame_.up;
    const double nearness = glm::dot(through_centre, focus_normal_) / focus_reach_;
    return {frame_.position + on_lens, glm::normalize(through_centre - nearness * on_lens)};
}

std::optional<glm::vec3> TiltShift::single_origin() const {
    if (aperture_.is_pinhole()) return glm::vec3(frame_.position);
    return std::nullopt;
}

}  // namespace phasetree::tracer
