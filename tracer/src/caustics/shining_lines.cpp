#include "caustics/shining_lines.hpp"

#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

std::optional<ShiningPiece> shining_piece(const Ray& ray, const World& world, const Scene& scene) {
    PathCounters uncounted;
    const Hit ahead = world.geometry().intersect(ray, uncounted);
    const Surface* leaves = std::get_if<Surface>(&ahead);
    if (!leaves || scene.lights.area_light_in_the_way(ray.origin, ray.direction, leaves->distance, LightSource{}))
        return std::nullopt;
    Ray back = ray;
    back.direction = -ray.direction;
    const Hit behind = world.geometry().intersect(back, uncounted);
    const Surface* begins = std::get_if<Surface>(&behind);
    float distance = begins ? begins->distance : Bounds::infinity;
    if (const auto lamp = scene.lights.area_light_seen(back.origin, back.direction, distance, false))
        distance = lamp->distance;
    return ShiningPiece{ray.origin + leaves->distance * ray.direction, leaves->distance + distance};
}

}  // namespace phasetree::tracer
