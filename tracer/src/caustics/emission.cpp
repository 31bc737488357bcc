#include "caustics/emission.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace phasetree::tracer {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// How much of the plane through the object a target covers, in radii of the object. Lines from a near light may pass
// through the object and yet meet the plane outside of its silhouette.
constexpr float target_of_infinite = 1.0f, target_of_area = 1.3f;

// This part of the photons is spread evenly whatever was learnt, because what was learnt is an estimate.
constexpr double even_part = 0.1;

bool bends_light(const Material& material) {
    const Clear* clear = std::get_if<Clear>(&material);
    return clear && clear->ior != 1.0f;
}

float squared_ior(const Scene& scene, Phase phase) {
    const float ior = std::get<Clear>(scene.materials[phase.index]).ior;
    return ior * ior;
}

}  // namespace

PhotonEmission::PhotonEmission(const World& world, const Scene& scene) : world_(world), scene_(scene) {
    const Bounds& bounds = world.geometry().bounds();
    if (bounds.empty() || !bounds.finite() || std::ranges::none_of(scene.materials, bends_light)) return;
    centre_ = bounds.centre();
    radius_ = 0.5005f * bounds.diagonal();
    for (const InfiniteLight& infinite : scene.lights.infinite())
        for (const Cap& part : std::visit([](const auto& light) { return light.bright_parts(); }, infinite))
            sources_.push_back({part, {}, {}, 1.0, {centre_, -part.axis(), target_of_infinite * radius_}});
    const auto target_from = [&](const glm::vec3& light) {
        const glm::vec3 towards = centre_ - light;
        const float distance = glm::length(towards);
        const glm::vec3 normal = distance > 0.0f ? towards / distance : glm::vec3(0.0f, 0.0f, 1.0f);
        return PhotonTarget(centre_, normal, target_of_area * radius_);
    };
    first_area_ = sources_.size();
    const std::span<const AreaLight> area = scene.lights.area();
    for (std::size_t i = 0; i < area.size(); ++i)
        sources_.push_back(
            {{}, i, {}, 1.0, target_from(std::visit([](const auto& light) { return light.centre(); }, area[i]))});
    first_point_ = sources_.size();
    const std::span<const AnyPointLight> points = scene.lights.points();
    for (std::size_t i = 0; i < points.size(); ++i)
        sources_.push_back(
            {{},
             {},
             i,
             1.0,
             target_from(std::visit([](const auto& light) { return glm::vec3(light.position()); }, points[i]))});
    for (Source& source : sources_) source.share = 1.0 / static_cast<double>(sources_.size());
}

void PhotonEmission::learn(std::vector<std::vector<double>> worth) {
    const auto sum_of = [](const std::vector<double>& cells) {
        return std::accumulate(cells.begin(), cells.end(), 0.0);
    };
    double total = 0;
    for (const std::vector<double>& cells : worth) total += sum_of(cells);
    if (!(total > 0)) return;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        std::vector<double>& cells = worth[i];
        const double sum = sum_of(cells);
        sources_[i].share = even_part / static_cast<double>(sources_.size()) + (1 - even_part) * sum / total;
        if (!(sum > 0)) continue;
        const double even = even_part / (1 - even_part) * sum / static_cast<double>(cells.size());
        for (double& cell : cells) cell += even;
        sources_[i].target.set_weights(cells);
    }
}

glm::vec3 PhotonEmission::outside_of_object(const glm::vec3& point, const glm::vec3& direction) const {
    const glm::vec3 nearest = point + direction * glm::dot(centre_ - point, direction);
    const glm::vec3 off = nearest - centre_;
    const float squared = radius_ * radius_ - glm::dot(off, off);
    return nearest - direction * std::sqrt(std::max(squared, 0.0f));
}

std::optional<EmittedPhoton> PhotonEmission::sample(Sampler& sampler, float time) const {
    double left = static_cast<double>(sampler.next());
    std::size_t number = 0;
    while (number + 1 < sources_.size() && left >= sources_[number].share) left -= sources_[number++].share;
    const Source& source = sources_[number];
    const glm::vec2 u_light = sampler.next2();
    const float u_cell = sampler.next();
    const PhotonTarget::Aim aim = source.target.sample(u_cell, sampler.next2());
    if (source.point) return of_point_light(number, aim, time);

    glm::vec3 direction;
    float back = infinity;  // from the target to the light
    if (source.cap) {
        direction = -source.cap->sample(u_light);
    } else {
        const SurfacePoint from = std::visit([&](const auto& light) { return light.surface_point(u_light); },
                                             scene_.lights.area()[*source.area]);
        back = glm::length(aim.point - from.position);
        if (!(back > 0.0f)) return std::nullopt;
        direction = (aim.point - from.position) / back;
        if (!(glm::dot(direction, from.normal) > 0.0f)) return std::nullopt;
    }
    const std::optional<Ray> ray = start(aim.point, direction, back, time);
    if (!ray) return std::nullopt;
    const float density = line_density(ray->origin, -direction, ray->phase);
    const auto seen = scene_.lights.seen(ray->origin, -direction, infinity, false);
    if (!(density > 0.0f) || !seen) return std::nullopt;
    const float line = density * squared_ior(scene_, ray->phase);
    return EmittedPhoton{*ray, *seen, seen->radiance / line, density, number, aim.cell};
}

std::optional<Ray> PhotonEmission::start(const glm::vec3& target, const glm::vec3& direction, float back,
                                         float time) const {
    glm::vec3 origin = outside_of_object(target, direction);
    // A light within the sphere about the object: the photon starts at the light, but for a hair.
    if (glm::dot(target - origin, direction) > back) origin = target - direction * (back * (1 - 1e-5f));
    const TracedGeometry::Inside inside = world_.geometry().inside(origin, time);
    if (!is_clear(scene_.materials[inside.phase.index])) return std::nullopt;
    return Ray{origin, direction, inside.phase, {}, inside.in};
}

std::optional<EmittedPhoton> PhotonEmission::of_point_light(std::size_t number, const PhotonTarget::Aim& aim,
                                                            float time) const {
    const Source& source = sources_[number];
    const auto& light = scene_.lights.points()[*source.point];
    const glm::vec3 from = std::visit([](const auto& any) { return glm::vec3(any.position()); }, light);
    const float back = glm::length(aim.point - from);
    if (!(back > 0.0f)) return std::nullopt;
    const glm::vec3 direction = (aim.point - from) / back;
    const glm::vec3 intensity = std::visit([&](const auto& any) { return any.intensity(direction); }, light);
    const float density = direction_density(source, direction);
    const std::optional<Ray> ray = start(aim.point, direction, back, time);
    if (!ray || !(density > 0.0f) || intensity == glm::vec3(0.0f)) return std::nullopt;
    const Lights::Emission emission{glm::length(ray->origin - from), intensity,
                                    OfPointLight{static_cast<std::uint32_t>(*source.point)}};
    return EmittedPhoton{*ray, emission, intensity / density, density, number, aim.cell};
}

float PhotonEmission::direction_density(std::size_t point_light, const glm::vec3& from_light) const {
    const std::size_t source = first_point_ + point_light;
    return source < sources_.size() ? direction_density(sources_[source], from_light) : 0.0f;
}

float PhotonEmission::direction_density(const Source& source, const glm::vec3& from_light) const {
    const glm::vec3 at =
        std::visit([](const auto& any) { return glm::vec3(any.position()); }, scene_.lights.points()[*source.point]);
    const PhotonTarget::Crossing crossing = source.target.crossing(at, from_light);
    if (!(crossing.density > 0.0f) || !(crossing.distance > 0.0f)) return 0.0f;
    return static_cast<float>(source.share) * crossing.density * crossing.distance * crossing.distance;
}

float PhotonEmission::line_density(const glm::vec3& origin, const glm::vec3& towards_light, Phase phase) const {
    float sum = 0;
    const auto add = [&](const Source& source) {
        sum += static_cast<float>(source.share) * density_of(source, origin, towards_light);
    };
    for (std::size_t i = 0; i < first_area_; ++i) add(sources_[i]);
    if (first_area_ < first_point_)
        scene_.lights.for_each_area_light_near(origin, towards_light,
                                               [&](std::uint32_t number) { add(sources_[first_area_ + number]); });
    return sum / squared_ior(scene_, phase);
}

float PhotonEmission::density_of(const Source& source, const glm::vec3& origin, const glm::vec3& towards_light) const {
    const PhotonTarget::Crossing crossing = source.target.crossing(origin, -towards_light);
    if (!(crossing.density > 0.0f)) return 0.0f;
    if (source.cap) return crossing.density * source.cap->pdf(towards_light);
    return std::visit(
        [&](const auto& light) {
            const std::optional<float> distance = light.intersect(origin, towards_light);
            if (!distance) return 0.0f;
            const glm::vec3 point = origin + *distance * towards_light;
            const float cosine = -glm::dot(towards_light, light.normal_at(point));
            const float to_target = crossing.distance + *distance;
            if (!(cosine > 0.0f) || !(to_target > 0.0f)) return 0.0f;
            return crossing.density * to_target * to_target / (light.area() * cosine);
        },
        scene_.lights.area()[*source.area]);
}

}  // namespace phasetree::tracer
