#include "caustics/segments_in_media.hpp"

#include "phasetree/math/bounds.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

std::optional<MediumSegment> medium_segment(const Ray& ray, const World& world, const Scene& scene) {
    PathCounters uncounted;
    const Hit ahead = world.geometry().intersect(ray, uncounted);
    const Surface* end = std::get_if<Surface>(&ahead);
    if (!end || !continues_photons(end->bsdf(), *end)) return std::nullopt;
    if (scene.lights.area_light_in_the_way(ray.origin, ray.direction, end->distance, LightSource{}))
        return std::nullopt;
    Ray backwards = ray;
    backwards.direction = -ray.direction;
    const Hit behind = world.geometry().intersect(backwards, uncounted);
    const Surface* begin = std::get_if<Surface>(&behind);
    float distance = begin ? begin->distance : Bounds::infinity;
    if (const auto lamp = scene.lights.area_light_seen(backwards.origin, backwards.direction, distance, false))
        distance = lamp->distance;
    return MediumSegment{ray.origin + end->distance * ray.direction, end->distance + distance};
}

}  // namespace phasetree::tracer
