#include "camera/thin_lens.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double half_fov(float vertical_fov_degrees) {
    if (!(vertical_fov_degrees > 0.0f) || !(vertical_fov_degrees < 180.0f)) {
        throw std::invalid_argument("the camera's vertical field of view must be between 0 and 180 degrees");
    }
    return 0.5 * static_cast<double>(vertical_fov_degrees) * std::numbers::pi / 180.0;
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

float lens_radius_from_f_number(float f_number, float vertical_fov_degrees, float sensor_height) {
    if (!(f_number > 0.0f)) throw std::invalid_argument("the camera's f-number must be positive");
    if (!(sensor_height > 0.0f)) throw std::invalid_argument("the camera's sensor height must be positive");
    const double focal_length = 0.5 * static_cast<double>(sensor_height) / std::tan(half_fov(vertical_fov_degrees));
    return static_cast<float>(focal_length / (2.0 * static_cast<double>(f_number)));
}

ThinLens::ThinLens(const ThinLensParameters& p) : position_(p.position), filter_(p.filter) {
    if (!finite(p.position)) throw std::invalid_argument("the camera's position must be three finite numbers");
    if (!finite(p.look_at)) throw std::invalid_argument("the point the camera looks at must be three finite numbers");
    if (!finite(p.up)) throw std::invalid_argument("the camera's up direction must be three finite numbers");
    if (p.width < 1 || p.height < 1) throw std::invalid_argument("the image must have at least one pixel");
    const glm::dvec3 axis = glm::dvec3(p.look_at) - position_;
    const double distance = glm::length(axis);
    if (!(distance > 0.0)) throw std::invalid_argument("the camera's position and the point it looks at are the same");
    if (!std::isfinite(p.lens_radius) || p.lens_radius < 0.0f) {
        throw std::invalid_argument("the camera's lens radius must be a finite number and not negative");
    }
    if (p.focus_distance && !(std::isfinite(*p.focus_distance) && *p.focus_distance > 0.0f)) {
        throw std::invalid_argument("the camera's focus distance must be a positive number");
    }
    forward_ = axis / distance;
    right_ = right_of(forward_, p.up);
    up_ = glm::cross(right_, forward_);
    half_width_ = 0.5 * p.width;
    half_height_ = 0.5 * p.height;
    pixel_size_ = std::tan(half_fov(p.vertical_fov_degrees)) / half_height_;
    lens_radius_ = p.lens_radius;
    focus_distance_ = p.focus_distance ? static_cast<double>(*p.focus_distance) : distance;
}

CameraRay ThinLens::generate(int x, int y, const glm::vec2& filter_sample, const glm::vec2& lens_sample) const {
    const glm::vec2 offset = filter_.sample(filter_sample);
    const double film_x = (x + 0.5 + static_cast<double>(offset.x) - half_width_) * pixel_size_;
    const double film_y = (half_height_ - (y + 0.5 + static_cast<double>(offset.y))) * pixel_size_;
    const glm::dvec3 through_centre = film_x * right_ + film_y * up_ + forward_;
    if (lens_radius_ == 0.0) return {position_, glm::normalize(through_centre)};
    const glm::dvec2 lens = lens_radius_ * glm::dvec2(square_to_uniform_disk(lens_sample));
    const glm::dvec3 on_lens = lens.x * right_ + lens.y * up_;
    return {position_ + on_lens, glm::normalize(focus_distance_ * through_centre - on_lens)};
}

}  // namespace phasetree::tracer
