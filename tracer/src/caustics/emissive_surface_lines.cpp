#include "caustics/emissive_surface_lines.hpp"

#include "caustics/chord.hpp"
#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

enum class Heading { towards_the_light, with_the_light };

// Follows a straight line through clear boundaries to the first opaque surface before the distance `far`, unless a lamp
// is in front of it. A rectangle occludes from one side only, so the direction of the light matters.
FreeLine followed(Ray ray, float far, Heading heading, const World& world, const Scene& scene) {
    const glm::vec3 direction = ray.direction;
    PathCounters uncounted;
    const auto lamp_before = [&](float distance) -> std::optional<float> {
        if (heading == Heading::with_the_light)
            return scene.lights.area_light_in_the_way(ray.origin, direction, distance, LightSource{});
        const auto seen = scene.lights.area_light_seen(ray.origin, direction, distance, false);
        return seen ? std::optional(seen->distance) : std::nullopt;
    };
    float free = 0;
    for (int boundary = 0; boundary < longest_chain; ++boundary) {
        const Hit hit = world.geometry().intersect(ray, uncounted);
        const Surface* surface = std::get_if<Surface>(&hit);
        const float distance = surface ? surface->distance : far;
        if (const auto lamp = lamp_before(distance)) return {std::nullopt, free + *lamp};
        free += distance;
        if (!surface || free > far) return {std::nullopt, free};
        if (!surface->is_transparent()) return {*surface, free};
        ray = surface->transmitted(direction);
    }
    return {std::nullopt, free};
}

}  // namespace

FreeLine last_surface_in(const BoundingSphere& ball, const World& world, const Scene& scene, const glm::vec3& point,
                         const glm::vec3& direction, float time) {
    const std::optional<Chord> within = chord(ball, point, direction);
    if (!within) return {};
    const glm::vec3 end = point + within->leaves * direction;
    const TracedGeometry::Inside inside = world.geometry().inside(end, time);
    if (!is_clear(scene.materials[inside.phase.index])) return {};
    return followed({end, -direction, inside.phase, {}, inside.in}, within->leaves - within->enters,
                    Heading::towards_the_light, world, scene);
}

float free_distance(const Surface& from, const glm::vec3& direction, const World& world, const Scene& scene) {
    return followed(from.reflected(direction), Bounds::infinity, Heading::with_the_light, world, scene).free;
}

std::optional<float> distance_to_leave(const BoundingSphere& ball, const glm::vec3& origin,
                                       const glm::vec3& direction) {
    const std::optional<Chord> within = chord(ball, origin, direction);
    if (!within || !(within->enters <= 0.0f && within->leaves >= 0.0f)) return std::nullopt;
    return within->leaves;
}

}  // namespace phasetree::tracer
