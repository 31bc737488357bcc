#include "shading/bump.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "image/luminance.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

// The difference of two points closer than this share of the largest coordinate is mostly rounding error.
constexpr float least_half_distance = 1e-5f;
// Bumped normals are turned until their cosine with the viewing direction is about this, or that of the surface's own
// normal if that is less.
constexpr float least_cosine = 0.05f;

}  // namespace

glm::vec3 Bump::normal_at(const TexturePoint& place) const {
    const glm::vec3& p = place.position;
    const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const float half_distance = std::max(0.5f * std::abs(height), least_half_distance * largest);
    if (!(half_distance > 0.0f)) return place.normal;
    const Frame frame(place.normal);
    const auto slope = [&](const glm::vec3& along) {
        const auto brightness = [&](float by) { return luminance(color_at(texture, place.moved(by * along))); };
        return height * (brightness(half_distance) - brightness(-half_distance)) / (2.0f * half_distance);
    };
    const glm::vec3 x = frame.to_world({1, 0, 0}), y = frame.to_world({0, 1, 0});
    return glm::normalize(place.normal - slope(x) * x - slope(y) * y);
}

glm::vec3 turned_to_ray(const glm::vec3& bumped, const glm::vec3& flat, const glm::vec3& ray_direction) {
    const float cosine = -glm::dot(bumped, ray_direction);
    const float least = std::min(least_cosine, -glm::dot(flat, ray_direction));
    if (cosine >= least) return bumped;
    if (!(least > 0.0f)) return flat;
    return glm::normalize(bumped - (least - cosine) * ray_direction);
}

}  // namespace phasetree::tracer
