#include "lights/lights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>

#include "image/luminance.hpp"
#include "lights/check.hpp"

namespace phasetree::tracer {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// One weight per choice. Up to 64 need no heap.
class Scratch {
  public:
    explicit Scratch(std::size_t size) : values_(size, 0.0f, &arena_) {}
    operator std::span<float>() { return values_; }
    const std::pmr::vector<float>& values() const { return values_; }

  private:
    std::array<std::byte, 256> buffer_;
    std::pmr::monotonic_buffer_resource arena_{buffer_.data(), buffer_.size()};
    std::pmr::vector<float> values_;
};

// A sun whose centre is below the horizon may still be partly visible.
constexpr float least_cosine_of_sun = 0.02f;

// The direction and distance of a point light from p, and its irradiance there.
struct FromPoint {
    glm::vec3 direction;
    float distance;
    glm::vec3 irradiance;
};
FromPoint seen_from(const glm::vec3& p, const AnyPointLight& any) {
    return std::visit(
        [&](const auto& light) {
            const glm::dvec3 to_light = glm::dvec3(light.position()) - glm::dvec3(p);
            const double squared = glm::dot(to_light, to_light), distance = std::sqrt(squared);
            const glm::vec3 direction(to_light / distance);
            return FromPoint{direction, static_cast<float>(distance),
                             glm::vec3(glm::dvec3(light.intensity(-direction)) / squared)};
        },
        any);
}

glm::vec3 radiance_from(const ListedInfiniteLight& infinite, const glm::vec3& direction,
                        const Wavelengths* wavelengths) {
    const glm::vec3 radiance = std::visit([&](const auto& light) { return light.radiance(direction); }, infinite.light);
    return light_of(radiance, infinite.spectrum, wavelengths);
}

// Whether lights can be chosen by weights with this sum. Otherwise there is no sample.
bool is_usable(float total) {
    return total > 0.0f && total < infinity;
}

}  // namespace

std::size_t Lights::group_of(std::string_view name) {
    const auto found = std::ranges::find(groups_, name);
    if (found == groups_.end()) groups_.emplace_back(name);
    return static_cast<std::size_t>(std::ranges::find(groups_, name) - groups_.begin());
}

void Lights::add(InfiniteLight light, std::string_view group, SharedLightSpectrum spectrum) {
    const DiffuseIrradiance irradiance(light);
    infinite_.push_back({{std::move(light), group_of(group), std::move(spectrum)}, irradiance});
}

void Lights::add(AreaLight light, std::string_view group, SharedLightSpectrum spectrum) {
    area_.push_back({std::move(light), group_of(group), std::move(spectrum)});
    tree_.add(LightNode::Kind::area);
}

void Lights::add(AnyPointLight light, std::string_view group, SharedLightSpectrum spectrum) {
    points_.push_back({std::move(light), group_of(group), std::move(spectrum)});
    tree_.add(LightNode::Kind::point);
}

void Lights::add(const EmissivePart& part) {
    emissive_parts_.push_back(part);
    tree_.add(LightNode::Kind::emissive_part);
}

void Lights::cluster_lamps() {
    std::vector<LightTree::Lamp> lamps;
    const auto add_all = [&](const auto& lights, LightNode::Kind kind) {
        for (std::uint32_t i = 0; i < lights.size(); ++i)
            lamps.push_back(
                {{kind, i}, std::visit([](const auto& light) { return light.emission_bounds(); }, lights[i].light)});
    };
    add_all(area_, LightNode::Kind::area);
    add_all(points_, LightNode::Kind::point);
    for (std::uint32_t i = 0; i < emissive_parts_.size(); ++i)
        lamps.push_back({{LightNode::Kind::emissive_part, i}, emissive_parts_[i].emission_bounds()});
    tree_ = LightTree::of(lamps);
}

void Lights::add_to_groups(const glm::vec3& found, const Wavelengths* wavelengths, const LightSource& source,
                           const glm::vec3& direction, std::span<glm::vec3> groups) const {
    const glm::vec3 radiance = colour_of_found(found, wavelengths);
    const auto is_like_first = [&](const auto& infinite) { return infinite.group == infinite_.front().group; };
    if (const auto* area = std::get_if<OfAreaLight>(&source)) {
        groups[area_[area->index].group] += radiance;
    } else if (const auto* point = std::get_if<OfPointLight>(&source)) {
        groups[points_[point->index].group] += radiance;
    } else if (const auto* emissive = std::get_if<OfEmissiveSurface>(&source)) {
        groups[emissive->group] += radiance;
    } else if (std::holds_alternative<Background>(source) || infinite_.empty()) {
        groups[0] += radiance;
    } else if (std::ranges::all_of(infinite_, is_like_first)) {
        groups[infinite_.front().group] += radiance;
    } else if (const glm::vec3 all = infinite_radiance(direction, wavelengths); all == glm::vec3(0.0f)) {
        groups[infinite_.front().group] += radiance;
    } else {
        for (const ListedInfiniteLight& infinite : infinite_) {
            const glm::vec3 part = radiance_from(infinite, direction, wavelengths);
            glm::vec3 share(0.0f);
            // The light of a dispersed shadow ray has colours that the lights did not emit. It is divided by
            // brightness.
            for (int c = 0; c < 3; ++c)
                share[c] = found[c] * (all[c] > 0 ? part[c] / all[c] : luminance(part) / luminance(all));
            groups[infinite.group] += colour_of_found(share, wavelengths);
        }
    }
}

std::vector<SharedLightSpectrum> Lights::spectra() const {
    std::vector<SharedLightSpectrum> all;
    const auto add_all = [&](const auto& lights) {
        for (const auto& listed : lights) all.push_back(listed.spectrum);
    };
    add_all(infinite_);
    add_all(area_);
    add_all(points_);
    return all;
}

glm::vec3 Lights::infinite_radiance(const glm::vec3& direction, const Wavelengths* wavelengths) const {
    glm::vec3 sum(0.0f);
    for (const ListedInfiniteLight& infinite : infinite_) sum += radiance_from(infinite, direction, wavelengths);
    return sum;
}

void Lights::set_background(const std::optional<glm::vec3>& radiance) {
    if (radiance) check_colour(*radiance, "the background");
    background_ = radiance;
}

float Lights::weigh(const LightReceiver& at, std::span<float> weights) const {
    float total = 0.0f;
    std::size_t index = 0;
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        weights[index] = std::visit(
            [&](const auto& light) {
                const std::optional<glm::vec3> centre = light.centre_direction();
                // With portals, all of the light counts: what is seen through them is hardly found by chance.
                const float part = centre || !portals_.empty() ? 1.0f : infinite_[i].irradiance.unevenness();
                if (!at.normal) return part * light.fluence();
                if (!centre) return part * infinite_[i].irradiance.at(*at.normal);
                return light.fluence() * std::max(glm::dot(*centre, *at.normal), least_cosine_of_sun);
            },
            infinite_[i].light);
        total += weights[index++];
    }
    for (const LightNode& root : tree_.roots()) {
        weights[index] = received_from(root, at);
        total += weights[index++];
    }
    if (!portals_.empty()) move_weight_to_portals(at.p, weights);
    return total;
}

float Lights::received_from(const LightNode& node, const LightReceiver& at) const {
    if (node.kind == LightNode::Kind::cluster) return tree_.received(node.number, at);
    if (node.kind == LightNode::Kind::area)
        return std::visit(
            [&](const auto& light) {
                const double solid_angle = light.approximate_solid_angle(at.p);
                if (!(solid_angle > 0.0)) return 0.0f;
                const double cosine = at.normal ? mean_cosine(light.bounding_sphere(), at) : 1.0;
                return static_cast<float>(static_cast<double>(luminance(light.radiance())) * solid_angle * cosine);
            },
            area_[node.number].light);
    if (node.kind == LightNode::Kind::emissive_part) {
        const EmissivePart& part = emissive_parts_[node.number];
        const double cosine = at.normal ? mean_cosine(part.bounding_sphere(), at) : 1.0;
        return static_cast<float>(static_cast<double>(part.luminance()) * part.solid_angle(at.p) * cosine);
    }
    const FromPoint from_point = seen_from(at.p, points_[node.number].light);
    const float cosine = at.normal ? std::max(glm::dot(from_point.direction, *at.normal), 0.0f) : 1.0f;
    return cosine > 0.0f ? luminance(from_point.irradiance) * cosine : 0.0f;
}

// Moves a part of the weight of environments to the portals that p sees. The sum stays the same.
void Lights::move_weight_to_portals(const glm::vec3& p, std::span<float> weights) const {
    constexpr float part = 0.75f;
    const std::span<float> portals = weights.last(portals_.size());
    float solid_angle = 0.0f;
    for (std::size_t i = 0; i < portals_.size(); ++i) {
        portals[i] = static_cast<float>(portals_[i].approximate_solid_angle(p));
        solid_angle += portals[i];
    }
    if (!(solid_angle > 0.0f)) return;
    float moved = 0.0f;
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        if (std::visit([](const auto& light) { return light.centre_direction(); }, infinite_[i].light)) continue;
        moved += part * weights[i];
        weights[i] *= 1.0f - part;
    }
    for (float& portal : portals) portal *= moved / solid_angle;
}

template <class Hit>
float Lights::with_others(float density, const std::optional<Chosen>& chosen, const LightReceiver& at,
                          const glm::vec3& direction, std::span<const float> weights, float total,
                          const Hit& hit) const {
    const auto is_other = [&](std::size_t weight) {
        return weights[weight] > 0.0f && !(chosen && chosen->weight == weight);
    };
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        if (is_other(i))
            density += weights[i] / total *
                       std::visit([&](const auto& light) { return light.pdf(direction); }, infinite_[i].light);
    }
    float of_portals = 0.0f;
    for (std::size_t i = 0; i < portals_.size(); ++i)
        if (is_other(first_portal() + i)) of_portals += weights[first_portal() + i] * portals_[i].pdf(at.p, direction);
    density += of_portals / total;
    const auto given = [&](const LightNode& node) { return received_from(node, at); };
    tree_.for_each_maybe_hit_with_path(at.p, direction, given, [&](const LightNode& lamp, const auto& path) {
        // `pdf` returns the pdf of the lamp's own sampling.
        const auto add = [&](const auto& pdf) {
            if (chosen && chosen->lamp == lamp) return;
            const auto [root, probability] = path();
            const float weight = weights[infinite_.size() + root];
            if (weight * probability > 0.0f) density += weight / total * probability * pdf();
        };
        if (lamp.kind == LightNode::Kind::emissive_part) {
            if (chosen && chosen->lamp == lamp) return;
            if (const float pdf = emissive_parts_[lamp.number].pdf(at.p, direction); pdf > 0.0f)
                add([&] { return pdf; });
            return;
        }
        std::visit(
            [&](const auto& light) {
                const auto distance = light.intersect(at.p, direction);
                if (!distance) return;
                hit(lamp.number, *distance);
                add([&] { return light.pdf_at(at.p, direction, *distance); });
            },
            area_[lamp.number].light);
    });
    return density;
}

float Lights::pdf(const LightReceiver& at, const glm::vec3& direction) const {
    Scratch weights(weight_count());
    const float total = weigh(at, weights);
    if (!is_usable(total)) return 0.0f;
    return with_others(0.0f, {}, at, direction, weights.values(), total, [](std::uint32_t, float) {});
}

float Lights::point_light_probability(const LightReceiver& at, std::size_t index) const {
    Scratch weights(weight_count());
    const float total = weigh(at, weights);
    if (!is_usable(total)) return 0.0f;
    const LightNode light{LightNode::Kind::point, static_cast<std::uint32_t>(index)};
    const auto [root, probability] =
        tree_.path_to(light, [&](const LightNode& node) { return received_from(node, at); });
    return weights.values()[infinite_.size() + root] / total * probability;
}

std::optional<LightSample> Lights::sample(const LightReceiver& at, glm::vec2 u, const Wavelengths* wavelengths) const {
    const glm::vec3& p = at.p;
    Scratch scratch(weight_count());
    const float total = weigh(at, scratch);
    const std::span<const float> weights = scratch.values();
    if (!is_usable(total)) return std::nullopt;

    // If rounding leaves u beyond the sum, the last light with a weight is chosen.
    Chosen chosen{0};
    float sum = 0.0f;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!(weights[i] > 0.0f)) continue;
        chosen.weight = i;
        sum += weights[i];
        if (u.x * total < sum) break;
    }
    const float weight = weights[chosen.weight];
    u.x = std::clamp((u.x * total - (sum - weight)) / weight, 0.0f, 0x1.fffffep-1f);

    float probability = weight / total;
    if (chosen.weight >= infinite_.size() && chosen.weight < first_portal()) {
        const auto choice = tree_.choose(tree_.roots()[chosen.weight - infinite_.size()], u.x,
                                         [&](const LightNode& node) { return received_from(node, at); });
        if (!choice) return std::nullopt;
        chosen.lamp = choice->lamp;
        probability *= choice->probability;
        u.x = choice->u;
    }
    if (!(probability > 0.0f)) return std::nullopt;
    std::optional<DirectionSample> sampled;
    if (chosen.weight < infinite_.size()) {
        sampled = std::visit([&](const auto& light) { return light.sample(u); }, infinite_[chosen.weight].light);
    } else if (!chosen.lamp) {
        sampled = portals_[chosen.weight - first_portal()].sample(p, u);
    } else if (chosen.lamp->kind == LightNode::Kind::point) {
        const ListedLight<AnyPointLight>& point = points_[chosen.lamp->number];
        const FromPoint from_point = seen_from(p, point.light);
        const glm::vec3 irradiance = light_of(from_point.irradiance, point.spectrum, wavelengths);
        return LightSample{from_point.direction, from_point.distance, irradiance, probability,
                           OfPointLight{chosen.lamp->number}};
    } else if (chosen.lamp->kind == LightNode::Kind::emissive_part) {
        sampled = emissive_parts_[chosen.lamp->number].sample(p, u);
    } else {
        sampled = std::visit([&](const auto& light) { return light.sample(p, u); }, area_[chosen.lamp->number].light);
    }
    if (!sampled) return std::nullopt;
    const glm::vec3 wi = sampled->direction;

    std::optional<Emission> nearest_area_light;
    const bool is_area_light = chosen.lamp && chosen.lamp->kind == LightNode::Kind::area;
    bool misses_chosen_area_light = is_area_light;
    const float density = with_others(probability * sampled->pdf, chosen, at, wi, weights, total,
                                      [&](std::uint32_t number, float distance) {
                                          if (!nearest_area_light || distance < nearest_area_light->distance)
                                              nearest_area_light = emission_of(number, distance, wavelengths);
                                          if (is_area_light && chosen.lamp->number == number)
                                              misses_chosen_area_light = false;
                                      });
    // At the rim of a light, rounding can move the direction just outside.
    if (misses_chosen_area_light || !(density > 0.0f)) return std::nullopt;
    if (nearest_area_light)
        return LightSample{wi, nearest_area_light->distance, nearest_area_light->radiance, density,
                           nearest_area_light->source};
    return LightSample{wi, infinity, infinite_radiance(wi, wavelengths), density, InfiniteLights{}};
}

glm::vec3 Lights::direction_to(const LightNode& node, const glm::vec3& p) const {
    if (node.kind == LightNode::Kind::point) return seen_from(p, points_[node.number].light).direction;
    if (node.kind == LightNode::Kind::cluster) return glm::normalize(tree_.sphere(node.number).centre - p);
    if (node.kind == LightNode::Kind::emissive_part) return glm::normalize(emissive_parts_[node.number].centre() - p);
    const glm::vec2 middle(0.5f);
    return std::visit([&](const auto& light) { return light.sample(p, middle).direction; }, area_[node.number].light);
}

std::optional<glm::vec3> Lights::towards_brightest(const glm::vec3& p, const glm::vec3& normal) const {
    Scratch weights(weight_count());
    weigh(p, weights);
    std::optional<glm::vec3> brightest;
    float most = 0.0f;
    const auto consider = [&](float weight, const auto& direction_of) {
        if (!(weight > most)) return false;
        const std::optional<glm::vec3> direction = direction_of();
        if (!direction || !(glm::dot(*direction, normal) > 0.0f)) return false;
        most = weight;
        brightest = direction;
        return true;
    };
    for (std::size_t i = 0; i < infinite_.size(); ++i)
        consider(weights.values()[i], [&] {
            return std::visit([](const auto& light) { return light.centre_direction(); }, infinite_[i].light);
        });
    std::optional<LightNode> node;
    for (std::size_t i = 0; i < tree_.roots().size(); ++i) {
        const LightNode root = tree_.roots()[i];
        if (consider(weights.values()[infinite_.size() + i], [&] { return std::optional(direction_to(root, p)); }))
            node = root;
    }
    // Follow the brighter member of each cluster down to a lamp, or until none is on the normal's side.
    while (node && node->kind == LightNode::Kind::cluster) {
        std::optional<LightNode> next;
        most = 0.0f;
        for (const LightNode& member : tree_.members(node->number))
            if (consider(received_from(member, p), [&] { return std::optional(direction_to(member, p)); }))
                next = member;
        node = next;
    }
    return brightest;
}

}  // namespace phasetree::tracer
