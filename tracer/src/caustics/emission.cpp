#include "caustics/emission.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "caustics/glowing_lines.hpp"
#include "caustics/shining_lines.hpp"
#include "image/luminance.hpp"
#include "phasetree/math/float_mode.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// If there are more emissive parts of surfaces and media than this, none emits photons, because the cells of each take
// memory and must be learned.
constexpr std::size_t most_glowing = 4096;
// Photons of one direction start anywhere in the ball around such a part, so fine cells of directions gain little,
// least of all for media.
constexpr int direction_cells_a_side_of_glowing = 16, direction_cells_a_side_of_shining = 8;
// At most this many points, over all balls, are evaluated for the brightness of media.
constexpr std::size_t most_places_asked = 1 << 20;

// This share of the photons, and of points in a medium, is spread evenly, because learned weights and the known
// brightness of a medium are estimates.
constexpr double even_part = 0.1;

// Whether photons continue after meeting this material.
bool sends_light_on(const Material& material) {
    if (const Clear* clear = std::get_if<Clear>(&material)) return clear->ior != 1.0f;
    return has_metal(material);
}

double sum_of(const std::vector<double>& cells) {
    return std::accumulate(cells.begin(), cells.end(), 0.0);
}

// Raises all weights by the same amount, such that even_part of the choices is uniform.
void add_even_part(std::vector<double>& cells) {
    const double even = even_part / (1 - even_part) * sum_of(cells) / static_cast<double>(cells.size());
    for (double& cell : cells) cell += even;
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
    if (bounds.empty() || !bounds.finite() || std::ranges::none_of(scene.materials, sends_light_on)) return;
    centre_ = bounds.centre();
    radius_ = 0.5005f * bounds.diagonal();
    for (const ListedInfiniteLight& infinite : scene.lights.infinite())
        for (const Cap& part : std::visit([](const auto& light) { return light.bright_parts(); }, infinite.light))
            sources_.push_back(OfCap{part, {centre_, -part.axis(), radius_}});
    const auto aim_of = [&](const BoundingSphere& lamp) { return PhotonAim(lamp, {centre_, radius_}); };
    first_area_ = sources_.size();
    for (const ListedLight<AreaLight>& area : scene.lights.area())
        sources_.push_back(
            OfArea{sources_.size() - first_area_,
                   aim_of(std::visit([](const auto& light) -> BoundingSphere { return light.bounding_sphere(); },
                                     area.light))});
    first_point_ = sources_.size();
    for (const ListedLight<AnyPointLight>& point : scene.lights.points())
        sources_.push_back(OfPoint{sources_.size() - first_point_, aim_of({position_of(point.light), 0.0f})});
    first_glowing_ = sources_.size();
    const std::span<const GlowingPart> glowing = scene.lights.glowing();
    if (glowing.size() <= most_glowing)
        for (const GlowingPart& part : glowing) {
            if (part.is_of_surface())
                sources_.push_back(
                    OfGlowing{part.bounding_sphere(), PhotonDirections(direction_cells_a_side_of_glowing)});
            else
                sources_.push_back(OfShining{PhotonPlaces(part.bounding_sphere()),
                                             PhotonDirections(direction_cells_a_side_of_shining)});
        }
    tbb::parallel_for(first_glowing_, sources_.size(), [&](std::size_t i) {
        const FlushSubnormals flush;
        if (OfShining* source = std::get_if<OfShining>(&sources_[i]))
            prefer_bright_places(source->places, most_places_asked / (glowing.size() * source->places.cells()));
    });
    if (!sources_.empty()) choice_ = CellChoice(sources_.size());
}

void PhotonEmission::prefer_bright_places(PhotonPlaces& places, std::size_t asked_a_cell) const {
    const std::size_t asked = std::clamp<std::size_t>(asked_a_cell, 1, 8);
    std::vector<double> brightness(places.cells());
    for (std::size_t cell = 0; cell < places.cells(); ++cell) {
        if (!places.meets_ball(cell)) continue;
        for (std::size_t k = 0; k < asked; ++k) {
            // The centres of the cell's octants, or of one octant that differs from cell to cell. Moving media are
            // evaluated at several times.
            const std::size_t eighth = (cell + k) % 8;
            const glm::vec3 in_cell(eighth & 1 ? 0.75f : 0.25f, eighth & 2 ? 0.75f : 0.25f, eighth & 4 ? 0.75f : 0.25f);
            const double time =
                scene_.moves() ? std::fmod(std::numbers::phi * static_cast<double>(cell + 8 * k), 1.0) : 0.0;
            brightness[cell] += brightness_at(places.place(cell, in_cell), static_cast<float>(time));
        }
    }
    if (!(sum_of(brightness) > 0)) return;
    add_even_part(brightness);
    places.set_weights(brightness);
}

double PhotonEmission::brightness_at(const glm::vec3& place, float time) const {
    const TracedGeometry::Inside inside = world_.geometry().inside(place, time);
    const Clear* clear = std::get_if<Clear>(&scene_.materials[inside.phase.index]);
    if (!clear || !shines(clear->interior)) return 0;
    // A ray of length 0 transforms the point into the medium's own space. Its direction does not matter.
    const Ray ray{place, {0, 0, 1}, inside.phase, {}, inside.in};
    const float share = share_of_emission(clear->interior, world_.geometry().way_through_medium(ray, 0.0f).origin);
    return static_cast<double>(share * luminance(emission(clear->interior)));
}

std::size_t PhotonEmission::cells(std::size_t source) const {
    return std::visit([](const auto& any) { return any.aim.cells(); }, sources_[source]);
}

void PhotonEmission::learn(std::vector<std::vector<double>> worth) {
    double total = 0;
    for (const std::vector<double>& cells : worth) total += sum_of(cells);
    if (!(total > 0)) return;
    std::vector<double> shares;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        std::vector<double>& cells = worth[i];
        const double sum = sum_of(cells);
        shares.push_back(even_part / static_cast<double>(sources_.size()) + (1 - even_part) * sum / total);
        if (!(sum > 0)) continue;
        add_even_part(cells);
        std::visit([&](auto& source) { source.aim.set_weights(cells); }, sources_[i]);
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

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const OfCap& source, Sampler& sampler) const {
    const glm::vec2 u_light = sampler.next2();
    const float u_cell = sampler.next();
    const PhotonTarget::Aim aim = source.aim.sample(u_cell, sampler.next2());
    return Line{aim.point, -source.cap.sample(u_light), infinity, aim.cell};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const OfArea& source, Sampler& sampler) const {
    const glm::vec2 u_light = sampler.next2();
    const float u_cell = sampler.next();
    const SurfacePoint from = std::visit([&](const auto& light) { return light.surface_point(u_light); },
                                         scene_.lights.area()[source.number].light);
    const auto aimed = source.aim.sample(from.position, u_cell, sampler.next2());
    if (!aimed || !(glm::dot(aimed->direction, from.normal) > 0.0f)) return std::nullopt;
    return Line{from.position + aimed->distance * aimed->direction, aimed->direction, aimed->distance, aimed->cell};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const OfPoint& source, Sampler& sampler) const {
    // Draw the two numbers that choose a point on other lights, so that the next ones have the same dimensions for all
    // lights. Emissive media draw more.
    sampler.next2();
    const float u_cell = sampler.next();
    const glm::vec3 from = position_of(scene_.lights.points()[source.number].light);
    const auto aimed = source.aim.sample(from, u_cell, sampler.next2());
    if (!aimed) return std::nullopt;
    return Line{from + aimed->distance * aimed->direction, aimed->direction, aimed->distance, aimed->cell};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const OfGlowing& source, Sampler& sampler) const {
    const glm::vec2 across = square_to_uniform_disk(sampler.next2()) * source.ball.radius;
    const float u_cell = sampler.next();
    const auto [direction, cell] = source.aim.sample(u_cell, sampler.next2());
    return Line{source.ball.centre + Frame(direction).to_world({across, 0.0f}), direction, 0.0f, cell};
}

std::optional<PhotonEmission::Line> PhotonEmission::sampled_line(const OfShining& source, Sampler& sampler) const {
    const glm::vec2 u_place = sampler.next2();
    const float u_cell = sampler.next();
    const auto [direction, cell] = source.aim.sample(u_cell, sampler.next2());
    const float u_third = sampler.next();
    const auto place = source.places.sample(sampler.next(), {u_place, u_third});
    return place ? std::optional(Line{*place, direction, 0.0f, cell}) : std::nullopt;
}

std::optional<EmittedPhoton> PhotonEmission::photon_of_seen(const Line& line, const Start& start) const {
    const std::optional<Ray> ray = ray_on(line, start.time);
    if (!ray) return std::nullopt;
    const float density = line_density(ray->origin, -line.direction, ray->phase);
    if (!(density > 0.0f)) return std::nullopt;
    const auto seen = scene_.lights.seen(ray->origin, -line.direction, infinity, false, start.wavelengths);
    if (!seen || seen->radiance == glm::vec3(0.0f)) return std::nullopt;
    const float line_measure = density * squared_ior(scene_, ray->phase);
    return EmittedPhoton{*ray, *seen, seen->radiance / line_measure, density, start.source, line.cell};
}

std::optional<EmittedPhoton> PhotonEmission::photon_on(const Line& line, const OfPoint& point,
                                                       const Start& start) const {
    const AnyPointLight& light = scene_.lights.points()[point.number].light;
    const glm::vec3 intensity = scene_.lights.intensity(point.number, line.direction, start.wavelengths);
    const float density = direction_density(point.number, line.direction);
    if (!(density > 0.0f) || intensity == glm::vec3(0.0f)) return std::nullopt;
    const std::optional<Ray> ray = ray_on(line, start.time);
    if (!ray) return std::nullopt;
    const Lights::Emission emission{glm::length(ray->origin - position_of(light)), intensity,
                                    OfPointLight{static_cast<std::uint32_t>(point.number)}};
    return EmittedPhoton{*ray, emission, intensity / density, density, start.source, line.cell};
}

std::optional<EmittedPhoton> PhotonEmission::photon_on(const Line& line, const OfGlowing& glowing,
                                                       const Start& start) const {
    const auto [surface, free] =
        last_surface_in(glowing.ball, world_, scene_, line.through, line.direction, start.time);
    const auto emitted = surface ? surface->emitted(start.wavelengths) : std::nullopt;
    if (!emitted) return std::nullopt;
    // The distance is known except for rounding; enlarge it slightly so that the ball that sends the photon counts.
    const float density = line_density(*surface, -line.direction, free * (1 + 1e-5f));
    if (!(density > 0.0f)) return std::nullopt;
    const Ray ray = surface->reflected(line.direction);
    return EmittedPhoton{ray,
                         {0.0f, emitted->radiance, OfGlowingSurface{emitted->group}},
                         emitted->radiance / (density * squared_ior(scene_, ray.phase)),
                         density,
                         start.source,
                         line.cell};
}

std::optional<EmittedPhoton> PhotonEmission::photon_on(const Line& line, const OfShining&, const Start& start) const {
    const TracedGeometry::Inside inside = world_.geometry().inside(line.through, start.time);
    const Clear* clear = std::get_if<Clear>(&scene_.materials[inside.phase.index]);
    if (!clear || !shines(clear->interior)) return std::nullopt;
    const Ray ray{line.through, line.direction, inside.phase, {}, inside.in};
    const std::optional<ShiningPiece> piece = shining_piece(ray, world_, scene_);
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
                         .cell = line.cell,
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
    if (source >= first_glowing_) return 0.0f;
    return share(source) * std::get<OfPoint>(sources_[source])
                               .aim.density(position_of(scene_.lights.points()[point_light].light), from_light);
}

float PhotonEmission::line_density(const glm::vec3& origin, const glm::vec3& towards_light, Phase phase) const {
    float sum = 0, of_nearest = 0, nearest = infinity;
    if (first_area_ < first_point_)
        scene_.lights.for_each_lamp_near(LightNode::Kind::area, origin, towards_light, [&](std::uint32_t number) {
            const std::size_t i = first_area_ + number;
            const auto [density, distance] = met(std::get<OfArea>(sources_[i]), origin, towards_light);
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
        sum += share(i) * density(std::get<OfCap>(sources_[i]), origin, towards_light);
    return sum / squared_ior(scene_, phase);
}

float PhotonEmission::line_density(const Surface& glowing, const glm::vec3& towards_light, float known_free) const {
    if (first_glowing_ == sources_.size()) return 0.0f;
    const glm::vec3& origin = glowing.near_side.origin;
    const glm::vec3 direction = -towards_light;
    // The free distance is searched only if a ball reaches beyond the known part.
    float free = known_free;
    bool is_searched = false;
    float sum = 0;
    scene_.lights.for_each_lamp_near(LightNode::Kind::glowing, origin, direction, [&](std::uint32_t number) {
        const std::size_t i = first_glowing_ + number;
        const OfGlowing* source = std::get_if<OfGlowing>(&sources_[i]);
        if (!source) return;
        const std::optional<float> leaves = distance_to_leave(source->ball, origin, direction);
        if (!leaves) return;
        if (*leaves > free && !is_searched) {
            free = std::max(free, free_distance(glowing, direction, world_, scene_));
            is_searched = true;
        }
        if (*leaves > free) return;
        sum += share(i) * source->aim.density(direction) / (pi * source->ball.radius * source->ball.radius);
    });
    return sum / squared_ior(scene_, glowing.near_side.phase);
}

float PhotonEmission::line_density_in_medium(const glm::vec3& boundary, const glm::vec3& against_light, Phase phase,
                                             float length) const {
    if (first_glowing_ == sources_.size()) return 0.0f;
    float sum = 0;
    const auto add = [&](std::uint32_t number) {
        const std::size_t i = first_glowing_ + number;
        const OfShining* source = std::get_if<OfShining>(&sources_[i]);
        if (!source) return;
        const float of_place = source->places.density_along(boundary, against_light, length);
        if (of_place > 0.0f) sum += share(i) * source->aim.density(-against_light) * of_place;
    };
    scene_.lights.for_each_lamp_near(LightNode::Kind::glowing, boundary, against_light, add, length);
    return sum / squared_ior(scene_, phase);
}

float PhotonEmission::density(const OfCap& source, const glm::vec3& origin, const glm::vec3& towards_light) const {
    const float of_direction = source.cap.pdf(towards_light);
    return of_direction > 0.0f ? source.aim.crossing(origin, -towards_light).density * of_direction : 0.0f;
}

PhotonEmission::LampOnLine PhotonEmission::met(const OfArea& source, const glm::vec3& origin,
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
