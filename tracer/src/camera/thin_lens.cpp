#include "camera/thin_lens.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

float lens_radius_from_f_number(float f_number, float vertical_fov_degrees, float sensor_height) {
    if (!(f_number > 0.0f)) throw std::invalid_argument("the camera's f-number must be positive");
    if (!(sensor_height > 0.0f)) throw std::invalid_argument("the camera's sensor height must be positive");
    const double focal_length =
        0.5 * static_cast<double>(sensor_height) / portable::tan(half_fov(vertical_fov_degrees));
    return static_cast<float>(focal_length / (2.0 * static_cast<double>(f_number)));
}

ThinLens::ThinLens(const ThinLensParameters& p, const glm::ivec2& resolution)
    : frame_(p.position, p.look_at, p.up), aperture_(p) {
    check_resolution(resolution);
    if (p.focus_distance && !(std::isfinite(*p.focus_distance) && *p.focus_distance > 0.0f)) {
        throw std::invalid_argument("the camera's focus distance must be a positive number");
    }
    half_width_ = 0.5 * resolution.x;
    half_height_ = 0.5 * resolution.y;
    pixel_size_ = portable::tan(half_fov(p.vertical_fov_degrees)) / half_height_;
    focus_distance_ = p.focus_distance ? static_cast<double>(*p.focus_distance) : frame_.distance;
}

CameraRay ThinLens::generate(const glm::dvec2& film, const glm::vec2& lens_sample) const {
    const double x = (film.x - half_width_) * pixel_size_;
    const double y = (half_height_ - film.y) * pixel_size_;
    const glm::dvec3 through_centre = x * frame_.right + y * frame_.up + frame_.forward;
    if (aperture_.is_pinhole()) return {frame_.position, glm::normalize(through_centre)};
    const glm::dvec2 lens = aperture_.sample(lens_sample);
    const glm::dvec3 on_lens = lens.x * frame_.right + lens.y * frame_.up;
    return {frame_.position + on_lens, glm::normalize(focus_distance_ * through_centre - on_lens)};
}

std::optional<glm::vec3> ThinLens::single_origin() const {
    if (aperture_.is_pinhole()) return glm::vec3(frame_.position);
    return std::nullopt;
}

}  // namespace phasetree::tracer
