#include "rays/camera_rays.hpp"

#include <algorithm>
#include <cmath>

#include "film/film.hpp"

namespace phasetree::bench {

Rays camera_rays(tracer::AnyCameraParameters parameters, int width, int height) {
    if (auto* lens = std::get_if<tracer::ThinLensParameters>(&parameters)) lens->lens_radius = 0;
    const tracer::FilmSettings settings{.width = width, .height = height};
    const tracer::Film film(settings, settings.whole());
    const tracer::Camera camera(parameters, settings.resolution());
    Rays rays;
    rays.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const tracer::CameraRay ray = camera.generate(film.sample_position(x, y, {0.5f, 0.5f}), {0.5f, 0.5f});
            rays.push_back({ray.origin, ray.direction, vacuum});
        }
    }
    return rays;
}

tracer::ThinLensParameters camera_for(const Bounds& box) {
    tracer::ThinLensParameters camera;
    camera.look_at = box.centre();
    camera.position = camera.look_at + glm::normalize(glm::vec3(0.1f, -1, 0.15f)) * (2 * box.diagonal());
    const glm::vec3 axis = glm::normalize(camera.look_at - camera.position);
    float widest = 0;  // tangent of half the angle, for a square image
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 to = box.corner(i) - camera.position;
        const float along = glm::dot(to, axis);
        const glm::vec3 right = glm::normalize(glm::cross(axis, glm::vec3(0, 0, 1)));
        const glm::vec3 up = glm::cross(right, axis);
        widest = std::max({widest, std::abs(glm::dot(to, right)) / along, std::abs(glm::dot(to, up)) / along});
    }
    camera.vertical_fov_degrees = glm::degrees(2 * std::atan(1.02f * widest));
    return camera;
}

}  // namespace phasetree::bench
