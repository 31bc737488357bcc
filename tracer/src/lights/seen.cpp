// The part of Lights that determines what is seen along a line, by rays and by light that travels the other way.
// lights.cpp chooses lights.
#include <algorithm>
#include <limits>

#include "lights/lights.hpp"

namespace phasetree::tracer {

namespace {

constexpr float nothing_in_the_way = std::numeric_limits<float>::infinity();

}  // namespace

Lights::Emission Lights::emission_of(std::uint32_t area_light, float distance, const Wavelengths* wavelengths) const {
    const glm::vec3 radiance =
        std::visit([](const auto& light) { return glm::vec3(light.radiance()); }, area_[area_light].light);
    return {distance, light_of(radiance, area_[area_light].spectrum, wavelengths), OfAreaLight{area_light}};
}

float Lights::emissive_luminance(const glm::vec3& origin, const glm::vec3& direction) const {
    float brightest = 0;
    if (emissive_parts_.empty()) return brightest;
    for_each_lamp_near(LightNode::Kind::emissive_part, origin, direction, [&](std::uint32_t number) {
        const EmissivePart& part = emissive_parts_[number];
        if (part.luminance() > brightest && part.is_met(origin, direction)) brightest = part.luminance();
    });
    return brightest;
}

glm::vec3 Lights::intensity(std::size_t index, const glm::vec3& away, const Wavelengths* wavelengths) const {
    const glm::vec3 intensity =
        std::visit([&](const auto& light) { return light.intensity(away); }, points_[index].light);
    return light_of(intensity, points_[index].spectrum, wavelengths);
}

std::optional<Lights::Emission> Lights::area_light_seen(const glm::vec3& origin, const glm::vec3& direction,
                                                        float geometry, bool camera_ray,
                                                        const Wavelengths* wavelengths) const {
    if (area_.empty()) return std::nullopt;
    std::optional<Emission> nearest;
    const auto farthest = [&] { return nearest ? nearest->distance : geometry; };
    tree_.for_each_maybe_hit(origin, direction, farthest, [&](const LightNode& lamp) {
        if (lamp.kind != LightNode::Kind::area) return;
        std::visit(
            [&](const auto& light) {
                if (camera_ray && !light.visible_to_camera()) return;
                const auto distance = light.intersect(origin, direction);
                if (distance && *distance < farthest()) nearest = emission_of(lamp.number, *distance, wavelengths);
            },
            area_[lamp.number].light);
    });
    return nearest;
}

std::optional<float> Lights::area_light_in_the_way(const glm::vec3& origin, const glm::vec3& direction, float far,
                                                   const LightSource& own) const {
    const auto* left_out = std::get_if<OfAreaLight>(&own);
    std::optional<float> nearest;
    for_each_lamp_near(LightNode::Kind::area, origin, direction, [&](std::uint32_t number) {
        if (left_out && left_out->index == number) return;
        std::visit(
            [&](const auto& light) {
                const BoundingSphere ball = light.bounding_sphere();
                const float behind = glm::dot(ball.centre - origin, direction) + 1.01f * ball.radius;
                const float end = std::min(far, behind);
                if (!(end > 0.0f)) return;
                const auto back = light.intersect(origin + end * direction, -direction);
                if (back && *back < end && (!nearest || end - *back < *nearest)) nearest = end - *back;
            },
            area_[number].light);
    });
    return nearest;
}

std::optional<Lights::Emission> Lights::seen(const glm::vec3& origin, const glm::vec3& direction, float geometry,
                                             bool camera_ray, const Wavelengths* wavelengths) const {
    const std::optional<Emission> nearest = area_light_seen(origin, direction, geometry, camera_ray, wavelengths);
    if (nearest || geometry < nothing_in_the_way) return nearest;
    if (camera_ray && background_)
        return Emission{nothing_in_the_way, for_light(*background_, wavelengths), Background{}};
    return Emission{nothing_in_the_way, infinite_radiance(direction, wavelengths), InfiniteLights{}};
}

}  // namespace phasetree::tracer
