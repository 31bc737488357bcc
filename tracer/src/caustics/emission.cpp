#include "caustics/emission.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "caustics/emissive_surface_lines.hpp"
#include "caustics/segments_in_media.hpp"
#include "image/luminance.hpp"
#include "phasetree/math/float_mode.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// If there are more emissive parts of surfaces and media than this, none emits photons, because the bins of each take
// memory and must be learned.
constexpr std::size_t max_emissive_parts = 4096;
// Photons of one direction start anywhere in the ball around such a part, so fine bins of directions gain little,
// least of all for media.
constexpr int direction_bins_per_side_of_surface = 16, direction_bins_per_side_of_medium = 8;
// At most this many points, over all balls, are evaluated for the brightness of media.
constexpr std::size_t max_points_evaluated = 1 << 20;

// This share of the photons, and of points in a medium, is spread evenly, because learned weights and the known
// brightness of a medium are estimates.
constexpr double even_part = 0.1;

// Whether photons continue after meeting this material.
bool reflects_or_refracts(const Material& material) {
    if (const Clear* clear = std::get_if<Clear>(&material)) return clear->ior != 1.0f;
    return has_metal(material);
}

double sum_of(const std::vector<double>& bins) {
    return std::accumulate(bins.begin(), bins.end(), 0.0);
}

// Raises all weights by the same amount, such that even_part of the choices is uniform.
void add_even_part(std::vector<double>& bins) {
    const double even = even_part / (1 - even_part) * sum_of(bins) / static_cast<double>(bins.size());
    for (double& bin : bins) bin += even;
}

glm::vec3 position_of(const AnyPointLight& any) {
    return std::visit([](const auto& light) { return glm::vec3(light.position()); }, any);
}

float squared_ior(const Scene& scene, Phase phase) {
    const float ior = std::get<Clear>(scene.materials[phase.index]).ior;
    return ior * ior;
}

}  // namespace

PhotonEmission::PhotonEmission(const World& world, const Scene& scene) : world_(world), scene_(scene) {
    const Bounds& bounds = world.geometry().bounds();
    if (bounds.empty() || !bounds.finite() || std::ranges::none_of(scene.materials, reflects_or_refracts)) return;
    centre_ = bounds.centre();
    radius_ = 0.5005f * bounds.diagonal();
    for (const ListedInfiniteLight& infinite : scene.lights.infinite())
        for (const Cap& part : std::visit([](const auto& light) { return light.bright_parts(); }, infinite.light))
            sources_.push_back(CapSource{part, {centre_, -part.axis(), radius_}});
    const auto aim_of = [&](const BoundingSphere& lamp) { return PhotonAim(lamp, {centre_, radius_}); };
    first_area_ = sources_.size();
    for (const ListedLight<AreaLight>& area : scene.lights.area())
        sources_.push_back(
            AreaSource{sources_.size() - first_area_,
                       aim_of(std::visit([](const auto& light) -> BoundingSphere { return light.bounding_sphere(); },
                                         area.light))});
    first_point_ = sources_.size();
    for (const ListedLight<AnyPointLight>& point : scene.lights.points())
        sources_.push_back(PointSource{sources_.size() - first_point_, aim_of({position_of(point.light), 0.0f})});
    first_emissive_ = sources_.size();
    const std::span<const EmissivePart> parts = scene.lights.emissive_parts();
    if (parts.size() <= max_emissive_parts)
        for (const EmissivePart& part : parts) {
            if (part.is_of_surface())
                sources_.push_back(EmissiveSurfaceSource{part.bounding_sphere(),
                                                         PhotonDirections(direction_bins_per_side_of_surface)});
            else
                sources_.push_back(EmissiveMediumSource{PointsInBall(part.bounding_sphere()),
                                                        PhotonDirections(direction_bins_per_side_of_medium)});
        }
    tbb::parallel_for(first_emissive_, sources_.size(), [&](std::size_t i) {
        const FlushSubnormals flush;
        if (EmissiveMediumSource* source = std::get_if<EmissiveMediumSource>(&sources_[i]))
            prefer_bright_points(source->points, max_points_evaluated / (parts.size() * source->points.bins()));
    });
    if (!sources_.empty()) choice_ = DiscreteDistribution(sources_.size());
}

void PhotonEmission::prefer_bright_points(PointsInBall& points, std::size_t points_per_bin) const {
    const std::size_t count = std::clamp<std::size_t>(points_per_bin, 1, 8);
    std::vector<double> brightness(points.bins());
    for (std::size_t bin = 0; bin < points.bins(); ++bin) {
        if (!points.meets_ball(bin)) continue;
        for (std::size_t k = 0; k < count; ++k) {
            // The centres of the bin's octants, or of one octant that differs from bin to bin. Moving media are
            // evaluated at several times.
            const std::size_t eighth = (bin + k) % 8;
            const glm::vec3 in_bin(eighth & 1 ? 0.75f : 0.25f, eighth & 2 ? 0.75f : 0.25f, eighth & 4 ? 0.75f : 0.25f);
            const double time =
                scene_.moves() ? std::fmod(std::numbers::phi * static_cast<double>(bin + 8 * k), 1.0) : 0.0;
            brightness[bin] += brightness_at(points.point(bin, in_bin), static_cast<float>(time));
        }
    }
    if (!(sum_of(brightness) > 0)) return;
    add_even_part(brightness);
    points.set_weights(brightness);
}

double PhotonEmission::brightness_at(const glm::vec3& place, float time) const {
    const TracedGeometry::Inside inside = world_.geometry().inside(place, time);
    const Clear* clear = std::get_if<Clear>(&scene_.materials[inside.phase.index]);
    if (!clear || !is_emissive(clear->interior)) return 0;
    // A ray of length 0 transforms the point into the medium's own space. Its direction does not matter.
    const Ray ray{place, {0, 0, 1}, inside.phase, {}, inside.in};
    const float share = share_of_emission(clear->interior, world_.geometry().way_through_medium(ray, 0.0f).origin);
    return static_cast<double>(share * luminance(emission(clear->interior)));
}

std::size_t PhotonEmission::bins(std::size_t source) const {
    return std::visit([](const auto& any) { return any.aim.bins(); }, sources_[source]);
}

void PhotonEmission::learn(std::vector<std::vector<double>> worth) {
    double total = 0;
    for (const std::vector<double>& bins : worth) total += sum_of(bins);
    if (!(total > 0)) return;
    std::vector<double> shares;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        std::vector<double>& bins = worth[i];
        const double sum = sum_of(bins);
        shares.push_back(even_part / static_cast<double>(sources_.size()) + (1 - even_part) * sum / total);
        if (!(sum > 0)) continue;
        add_even_part(bins);
        std::visit([&](auto& source) { source.aim.set_weights(bins); }, sources_[i]);
    }
    choice_.set_weights(shares);
}

glm::vec3 PhotonEmission::outside_of_object(const glm::vec3& point, const glm::vec3& direction) const {
    const glm::vec3 nearest = point + direction * glm::dot(centre_ - point, direction);
    const glm::vec3 off = nearest - centre_;
    const float squared = radius_ * radius_ - glm::dot(off, off);
    return nearest - direction * std::sqrt(std::max(squared, 0.0f));
}

std::optional<EmittedPhoton> PhotonEmission::sample(Sampler& sampler, float time,
                                                    const Wavelengths* wavelengths) const {
    const std::size_t number = choice_.sample(static_cast<double>(sampler.next()));
    return std::visit(
        [&](const auto& source) -> std::optional<EmittedPhoton> {
            const std::optional<Line> line = sampled_line(source, sampler);
            return line ? photon_on(*line, source, {number, time, wavelengths, sampler}) : std::nullopt;
        },
        sources_[number]);
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const CapSource& source, Sampler& sampler) const {
    const glm::vec2 u_light = sampler.next2();
    const float u_bin = sampler.next();
    const PhotonTarget::Sample aim = source.aim.sample(u_bin, sampler.next2());
    return Line{aim.point, -source.cap.sample(u_light), infinity, aim.bin};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const AreaSource& source, Sampler& sampler) const {
    const glm::vec2 u_light = sampler.next2();
    const float u_bin = sampler.next();
    const SurfacePoint from = std::visit([&](const auto& light) { return light.surface_point(u_light); },
                                         scene_.lights.area()[source.number].light);
    const auto aimed = source.aim.sample(from.position, u_bin, sampler.next2());
    if (!aimed || !(glm::dot(aimed->direction, from.normal) > 0.0f)) return std::nullopt;
    return Line{from.position + aimed->distance * aimed->direction, aimed->direction, aimed->distance, aimed->bin};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const PointSource& source, Sampler& sampler) const {
    // Draw the two numbers that choose a point on other lights, so that the next ones have the same dimensions for all
    // lights. Emissive media draw more.
    sampler.next2();
    const float u_bin = sampler.next();
    const glm::vec3 from = position_of(scene_.lights.points()[source.number].light);
    const auto aimed = source.aim.sample(from, u_bin, sampler.next2());
    if (!aimed) return std::nullopt;
    return Line{from + aimed->distance * aimed->direction, aimed->direction, aimed->distance, aimed->bin};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const EmissiveSurfaceSource& source,
                                                                 Sampler& sampler) const {
    const glm::vec2 across = square_to_uniform_disk(sampler.next2()) * source.ball.radius;
    const float u_bin = sampler.next();
    const auto [direction, bin] = source.aim.sample(u_bin, sampler.next2());
    return Line{source.ball.centre + Frame(direction).to_world({across, 0.0f}), direction, 0.0f, bin};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const EmissiveMediumSource& source,
                                                                 Sampler& sampler) const {
    const glm::vec2 u_point = sampler.next2();
    const float u_bin = sampler.next();
    const auto [direction, bin] = source.aim.sample(u_bin, sampler.next2());
    const float u_third = sampler.next();
    const auto place = source.points.sample(sampler.next(), {u_point, u_third});
    return place ? std::optional(Line{*place, direction, 0.0f, bin}) : std::nullopt;
}

std::optional<EmittedPhoton> PhotonEmission::photon_of_visible_light(const Line& line, const Start& start) const {
    const std::optional<Ray> ray = ray_on(line, start.time);
    if (!ray) return std::nullopt;
    const float density = line_density(ray->origin, -line.direction, ray->phase);
    if (!(density > 0.0f)) return std::nullopt;
    const auto seen = scene_.lights.seen(ray->origin, -line.direction, infinity, false, start.wavelengths);
    if (!seen || seen->radiance == glm::vec3(0.0f)) return std::nullopt;
    const float line_measure = density * squared_ior(scene_, ray->phase);
    return EmittedPhoton{*ray, *seen, seen->radiance / line_measure, density, start.source, line.bin};
}

std::optional<EmittedPhoton> PhotonEmission::photon_on(const Line& line, const PointSource& point,
                                                       const Start& start) const {
    const AnyPointLight& light = scene_.lights.points()[point.number].light;
    const glm::vec3 intensity = scene_.lights.intensity(point.number, line.direction, start.wavelengths);
    const float density = direction_density(point.number, line.direction);
    if (!(density > 0.0f) || intensity == glm::vec3(0.0f)) return std::nullopt;
    const std::optional<Ray> ray = ray_on(line, start.time);
    if (!ray) return std::nullopt;
    const Lights::Emission emission{glm::length(ray->origin - position_of(light)), intensity,
                                    OfPointLight{static_cast<std::uint32_t>(point.number)}};
    return EmittedPhoton{*ray, emission, intensity / density, density, start.source, line.bin};
}

std::optional<EmittedPhoton> PhotonEmission::photon_on(const Line& line, const EmissiveSurfaceSource& emissive,
                                                       const Start& start) const {
    const auto [surface, free] =
        last_surface_in(emissive.ball, world_, scene_, line.through, line.direction, start.time);
    const auto emitted = surface ? surface->emitted(start.wavelengths) : std::nullopt;
    if (!emitted) return std::nullopt;
    // The distance is known except for rounding; enlarge it slightly so that the ball that sends the photon counts.
    const float density = line_density(*surface, -line.direction, free * (1 + 1e-5f));
    if (!(density > 0.0f)) return std::nullopt;
    const Ray ray = surface->reflected(line.direction);
    return EmittedPhoton{ray,
                         {0.0f, emitted->radiance, OfEmissiveSurface{emitted->group}},
                         emitted->radiance / (density * squared_ior(scene_, ray.phase)),
                         density,
                         start.source,
                         line.bin};
}

std::optional<EmittedPhoton> PhotonEmission::photon_on(const Line& line, const EmissiveMediumSource&,
                                                       const Start& start) const {
    const TracedGeometry::Inside inside = world_.geometry().inside(line.through, start.time);
    const Clear* clear = std::get_if<Clear>(&scene_.materials[inside.phase.index]);
    if (!clear || !is_emissive(clear->interior)) return std::nullopt;
    const Ray ray{line.through, line.direction, inside.phase, {}, inside.in};
    const std::optional<MediumSegment> piece = medium_segment(ray, world_, scene_);
    if (!piece) return std::nullopt;
    const Ray from_boundary{piece->boundary, -line.direction, inside.phase, {}, inside.in};
    const float density = line_density_in_medium(piece->boundary, from_boundary.direction, inside.phase, piece->length);
    if (!(density > 0.0f)) return std::nullopt;
    const Way way = world_.geometry().way_through_medium(from_boundary, piece->length, start.wavelengths);
    const glm::vec3 radiance = pass(clear->interior, way, start.sampler).emitted;
    if (radiance == glm::vec3(0.0f)) return std::nullopt;
    // Emission of a medium belongs to no lamp and is recorded with the background, as for paths.
    return EmittedPhoton{.ray = ray,
                         .emission = {0.0f, radiance, Background{}},
                         .power = radiance / (density * squared_ior(scene_, ray.phase)),
                         .line_density = density,
                         .source = start.source,
                         .bin = line.bin,
                         .is_of_medium = true};
}

std::optional<Ray> PhotonEmission::ray_on(const Line& line, float time) const {
    glm::vec3 origin = outside_of_object(line.through, line.direction);
    // If the light is inside the sphere around the object, the photon starts just in front of the light.
    if (glm::dot(line.through - origin, line.direction) > line.back)
        origin = line.through - line.direction * (line.back * (1 - 1e-5f));
    const TracedGeometry::Inside inside = world_.geometry().inside(origin, time);
    if (!is_clear(scene_.materials[inside.phase.index])) return std::nullopt;
    return Ray{origin, line.direction, inside.phase, {}, inside.in};
}

float PhotonEmission::direction_density(std::size_t point_light, const glm::vec3& from_light) const {
    const std::size_t source = first_point_ + point_light;
    if (source >= first_emissive_) return 0.0f;
    return share(source) * std::get<PointSource>(sources_[source])
                               .aim.density(position_of(scene_.lights.points()[point_light].light), from_light);
}

float PhotonEmission::line_density(const glm::vec3& origin, const glm::vec3& towards_light, Phase phase) const {
    float sum = 0, of_nearest = 0, nearest = infinity;
    if (first_area_ < first_point_)
        scene_.lights.for_each_lamp_near(LightNode::Kind::area, origin, towards_light, [&](std::uint32_t number) {
            const std::size_t i = first_area_ + number;
            const auto [density, distance] = lamp_on_line(std::get<AreaSource>(sources_[i]), origin, towards_light);
            sum += share(i) * density;
            if (distance < nearest) {
                nearest = distance;
                of_nearest = share(i) * density;
            }
        });
    // Photons of a lamp inside the sphere around the object start there, and photons of what is behind the lamp end
    // there.
    if (nearest < infinity) {
        const glm::vec3 lamp = origin + nearest * towards_light;
        if (glm::dot(outside_of_object(lamp, -towards_light) - lamp, towards_light) > 0.0f)
            return of_nearest / squared_ior(scene_, phase);
    }
    for (std::size_t i = 0; i < first_area_; ++i)
        sum += share(i) * density(std::get<CapSource>(sources_[i]), origin, towards_light);
    return sum / squared_ior(scene_, phase);
}

float PhotonEmission::line_density(const Surface& emissive, const glm::vec3& towards_light, float known_free) const {
    if (first_emissive_ == sources_.size()) return 0.0f;
    const glm::vec3& origin = emissive.near_side.origin;
    const glm::vec3 direction = -towards_light;
    // The free distance is searched only if a ball reaches beyond the known part.
    float free = known_free;
    bool is_searched = false;
    float sum = 0;
    scene_.lights.for_each_lamp_near(LightNode::Kind::emissive_part, origin, direction, [&](std::uint32_t number) {
        const std::size_t i = first_emissive_ + number;
        const EmissiveSurfaceSource* source = std::get_if<EmissiveSurfaceSource>(&sources_[i]);
        if (!source) return;
        const std::optional<float> leaves = distance_to_leave(source->ball, origin, direction);
        if (!leaves) return;
        if (*leaves > free && !is_searched) {
            free = std::max(free, free_distance(emissive, direction, world_, scene_));
            is_searched = true;
        }
        if (*leaves > free) return;
        sum += share(i) * source->aim.density(direction) / (pi * source->ball.radius * source->ball.radius);
    });
    return sum / squared_ior(scene_, emissive.near_side.phase);
}

float PhotonEmission::line_density_in_medium(const glm::vec3& boundary, const glm::vec3& towards_light, Phase phase,
                                             float length) const {
    if (first_emissive_ == sources_.size()) return 0.0f;
    float sum = 0;
    const auto add = [&](std::uint32_t number) {
        const std::size_t i = first_emissive_ + number;
        const EmissiveMediumSource* source = std::get_if<EmissiveMediumSource>(&sources_[i]);
        if (!source) return;
        const float of_point = source->points.density_along(boundary, towards_light, length);
        if (of_point > 0.0f) sum += share(i) * source->aim.density(-towards_light) * of_point;
    };
    scene_.lights.for_each_lamp_near(LightNode::Kind::emissive_part, boundary, towards_light, add, length);
    return sum / squared_ior(scene_, phase);
}

float PhotonEmission::density(const CapSource& source, const glm::vec3& origin, const glm::vec3& towards_light) const {
    const float of_direction = source.cap.pdf(towards_light);
    return of_direction > 0.0f ? source.aim.crossing(origin, -towards_light).density * of_direction : 0.0f;
}

PhotonEmission::LampOnLine PhotonEmission::lamp_on_line(const AreaSource& source, const glm::vec3& origin,
                                                        const glm::vec3& towards_light) const {
    return std::visit(
        [&](const auto& light) -> LampOnLine {
            const std::optional<float> distance = light.intersect(origin, towards_light);
            if (!distance) return {0.0f, infinity};
            const glm::vec3 point = origin + *distance * towards_light;
            const float cosine = -glm::dot(towards_light, light.normal_at(point));
            if (!(cosine > 0.0f)) return {0.0f, *distance};
            return {source.aim.density(point, -towards_light) / (light.area() * cosine), *distance};
        },
        scene_.lights.area()[source.number].light);
}

}  // namespace phasetree::tracer
