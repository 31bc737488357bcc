#include "caustics/glowing_lines.hpp"

#include <cmath>

#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

// Follows a straight line through clear boundaries to the first opaque surface before the distance `far`. Nothing if
// there is none, or if a lamp is before it. The length that it has followed is added to `passed`.
std::optional<Surface> first_opaque(Ray ray, float far, const World& world, const Scene& scene, float& passed) {
    const glm::vec3 direction = ray.direction;
    PathCounters uncounted;
    for (int boundary = 0; boundary < longest_chain; ++boundary) {
        const Hit hit = world.geometry().intersect(ray, uncounted);
        const Surface* surface = std::get_if<Surface>(&hit);
        const float distance = surface ? surface->distance : far;
        if (const auto lamp = scene.lights.area_light_seen(ray.origin, direction, distance, false)) {
            passed += lamp->distance;
            return std::nullopt;
        }
        passed += distance;
        if (!surface || passed > far) return std::nullopt;
        if (!surface->far_side) return *surface;
        ray = surface->transmitted(direction);
    }
    return std::nullopt;
}

// The distances along a line at which it enters and leaves a ball.
struct Chord {
    float enters, leaves;
};
std::optional<Chord> chord(const BoundingSphere& ball, const glm::vec3& origin, const glm::vec3& direction) {
    const float along = glm::dot(ball.centre - origin, direction);
    const glm::vec3 across = ball.centre - origin - along * direction;
    const float squared_half = ball.radius * ball.radius - glm::dot(across, across);
    if (!(squared_half > 0.0f)) return std::nullopt;
    const float half = std::sqrt(squared_half);
    return Chord{along - half, along + half};
}

}  // namespace

std::optional<Surface> last_surface_in(const BoundingSphere& ball, const World& world, const Scene& scene,
                                       const glm::vec3& point, const glm::vec3& direction, float time) {
    const std::optional<Chord> within = chord(ball, point, direction);
    if (!within) return std::nullopt;
    const glm::vec3 end = point + within->leaves * direction;
    const TracedGeometry::Inside inside = world.geometry().inside(end, time);
    if (!is_clear(scene.materials[inside.phase.index])) return std::nullopt;
    float passed = 0;
    return first_opaque({end, -direction, inside.phase, {}, inside.in}, within->leaves - within->enters, world, scene,
                        passed);
}

float free_distance(const Surface& from, const glm::vec3& direction, const World& world, const Scene& scene) {
    float passed = 0;
    first_opaque(from.reflected(direction), Bounds::infinity, world, scene, passed);
    return passed;
}

std::optional<float> distance_to_leave(const BoundingSphere& ball, const glm::vec3& origin,
                                       const glm::vec3& direction) {
    const std::optional<Chord> within = chord(ball, origin, direction);
    if (!within || !(within->enters <= 0.0f && within->leaves >= 0.0f)) return std::nullopt;
    return within->leaves;
}

}  // namespace phasetree::tracer
