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

// One number a light, without the heap for the usual handful of them.
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

// A sun whose middle has set may still be seen in part.
constexpr float least_cosine_of_sun = 0.02f;

// Where a point light is from p, and the irradiance that it gives there.
struct FromPoint {
    glm::vec3 direction;
    float distance;
    glm::vec3 irradiance;
};
FromPoint seen_from(const glm::vec3& p, const AnyPointLight& any) {
    return std::visit(
        [&](const auto& light) {
            const glm::dvec3 way = glm::dvec3(light.position()) - glm::dvec3(p);
            const double squared = glm::dot(way, way);
            const glm::vec3 direction(way / std::sqrt(squared));
            return FromPoint{direction, static_cast<float>(std::sqrt(squared)),
                             glm::vec3(glm::dvec3(light.intensity(-direction)) / squared)};
        },
        any);
}

}  // namespace

std::size_t Lights::group_of(std::string_view name) {
    const auto found = std::ranges::find(groups_, name);
    if (found == groups_.end()) groups_.emplace_back(name);
    return static_cast<std::size_t>(std::ranges::find(groups_, name) - groups_.begin());
}

void Lights::add(InfiniteLight light, std::string_view group) {
    irradiance_.emplace_back(light);
    infinite_.push_back(std::move(light));
    infinite_group_.push_back(group_of(group));
}

void Lights::add(AreaLight light, std::string_view group) {
    area_.push_back(std::move(light));
    area_group_.push_back(group_of(group));
    tree_.add(LightNode::Kind::area);
}

void Lights::add(AnyPointLight light, std::string_view group) {
    points_.push_back(std::move(light));
    point_group_.push_back(group_of(group));
    tree_.add(LightNode::Kind::point);
}

void Lights::group_lamps() {
    if (area_.size() + points_.size() <= LightTree::most_compared) return;
    std::vector<LightTree::Lamp> lamps;
    const auto add_all = [&](const auto& lights, LightNode::Kind kind) {
        for (std::uint32_t i = 0; i < lights.size(); ++i)
            lamps.push_back(
                {{kind, i}, std::visit([](const auto& light) { return light.emission_bounds(); }, lights[i])});
    };
    add_all(area_, LightNode::Kind::area);
    add_all(points_, LightNode::Kind::point);
    tree_ = LightTree::grouped(lamps);
}

void Lights::add_to_groups(const glm::vec3& radiance, const Emission& emission, const glm::vec3& direction,
                           std::span<glm::vec3> groups) const {
    const auto is_like_first = [&](std::size_t group) { return group == infinite_group_.front(); };
    if (const auto* area = std::get_if<OfAreaLight>(&emission.source)) {
        groups[area_group_[area->index]] += radiance;
    } else if (const auto* point = std::get_if<OfPointLight>(&emission.source)) {
        groups[point_group_[point->index]] += radiance;
    } else if (std::holds_alternative<Background>(emission.source) || infinite_.empty()) {
        groups[0] += radiance;
    } else if (std::ranges::all_of(infinite_group_, is_like_first)) {
        groups[infinite_group_.front()] += radiance;
    } else {
        for (std::size_t i = 0; i < infinite_.size(); ++i) {
            const glm::vec3 part =
                std::visit([&](const auto& light) { return light.radiance(direction); }, infinite_[i]);
            for (int c = 0; c < 3; ++c)
                if (emission.radiance[c] > 0)
                    groups[infinite_group_[i]][c] += radiance[c] * (part[c] / emission.radiance[c]);
        }
    }
}

void Lights::set_background(const std::optional<glm::vec3>& radiance) {
    if (radiance) check_colour(*radiance, "the background");
    background_ = radiance;
}

// Fills in what each light gives, by which lights are chosen, infinite ones first; returns the sum.
float Lights::shares(const LightReceiver& at, std::span<float> shares) const {
    float total = 0.0f;
    std::size_t index = 0;
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        shares[index] = std::visit(
            [&](const auto& light) {
                const std::optional<glm::vec3> centre = light.centre_direction();
                // What is seen through portals is found by looking at them, and hardly by chance.
                const float part = centre || !portals_.empty() ? 1.0f : irradiance_[i].unevenness();
                if (!at.normal) return part * light.fluence();
                if (!centre) return part * irradiance_[i].at(*at.normal);
                return light.fluence() * std::max(glm::dot(*centre, *at.normal), least_cosine_of_sun);
            },
            infinite_[i]);
        total += shares[index++];
    }
    for (const LightNode& top : tree_.tops()) {
        shares[index] = given(top, at);
        total += shares[index++];
    }
    if (!portals_.empty()) share_with_portals(at.p, shares);
    return total;
}

float Lights::given(const LightNode& node, const LightReceiver& at) const {
    if (node.kind == LightNode::Kind::group) return tree_.received(node.number, at);
    if (node.kind == LightNode::Kind::area)
        return std::visit(
            [&](const auto& light) {
                const double solid_angle = light.approximate_solid_angle(at.p);
                if (!(solid_angle > 0.0)) return 0.0f;
                const double cosine = at.normal ? mean_cosine(light.bounding_sphere(), at) : 1.0;
                return static_cast<float>(static_cast<double>(luminance(light.radiance())) * solid_angle * cosine);
            },
            area_[node.number]);
    const FromPoint seen = seen_from(at.p, points_[node.number]);
    const float cosine = at.normal ? std::max(glm::dot(seen.direction, *at.normal), 0.0f) : 1.0f;
    return cosine > 0.0f ? luminance(seen.irradiance) * cosine : 0.0f;
}

// Moves a part of what lights at infinity that are all around are chosen by to the portals that p sees.
void Lights::share_with_portals(const glm::vec3& p, std::span<float> shares) const {
    constexpr float part = 0.75f;
    const std::span<float> portals = shares.last(portals_.size());
    float seen = 0.0f;
    for (std::size_t i = 0; i < portals_.size(); ++i) {
        portals[i] = static_cast<float>(portals_[i].approximate_solid_angle(p));
        seen += portals[i];
    }
    if (!(seen > 0.0f)) return;
    float moved = 0.0f;
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        if (std::visit([](const auto& light) { return light.centre_direction(); }, infinite_[i])) continue;
        moved += part * shares[i];
        shares[i] *= 1.0f - part;
    }
    for (float& portal : portals) portal *= moved / seen;
}

// What the portals add to the density of a direction, times the sum of `shares`; but for one of them, if it is one.
float Lights::portals_pdf(const glm::vec3& p, const glm::vec3& direction, std::span<const float> shares,
                          std::size_t except) const {
    const std::size_t first = shares.size() - portals_.size();
    float sum = 0.0f;
    for (std::size_t i = 0; i < portals_.size(); ++i)
        if (first + i != except && shares[first + i] > 0.0f) sum += shares[first + i] * portals_[i].pdf(p, direction);
    return sum;
}

float Lights::pdf(const LightReceiver& at, const glm::vec3& direction) const {
    const glm::vec3& p = at.p;
    Scratch scratch(size());
    const float total = shares(at, scratch);
    if (!(total > 0.0f) || total == infinity) return 0.0f;  // as sample() has it
    const std::span<const float> share_of = scratch.values();
    float sum = 0.0f;
    std::size_t index = 0;
    for (const InfiniteLight& any : infinite_) {
        const float share = share_of[index++] / total;
        if (share > 0.0f) sum += share * std::visit([&](const auto& light) { return light.pdf(direction); }, any);
    }
    const auto given_by = [&](const LightNode& node) { return given(node, at); };
    tree_.for_each_near(p, direction, given_by, [&](std::uint32_t number, std::size_t top, float probability) {
        const float share = share_of[infinite_.size() + top] / total * probability;
        if (!(share > 0.0f)) return;
        std::visit(
            [&](const auto& light) {
                if (const auto distance = light.intersect(p, direction))
                    sum += share * light.pdf_at(p, direction, *distance);
            },
            area_[number]);
    });
    return sum + portals_pdf(p, direction, share_of, size()) / total;
}

float Lights::point_light_probability(const LightReceiver& at, std::size_t index) const {
    Scratch scratch(size());
    const float total = shares(at, scratch);
    if (!(total > 0.0f) || total == infinity) return 0.0f;  // as sample() has it
    const LightNode light{LightNode::Kind::point, static_cast<std::uint32_t>(index)};
    const auto [top, probability] = tree_.way_to(light, [&](const LightNode& node) { return given(node, at); });
    return scratch.values()[infinite_.size() + top] / total * probability;
}

std::optional<LightSample> Lights::sample(const LightReceiver& at, glm::vec2 u) const {
    const glm::vec3& p = at.p;
    Scratch scratch(size());
    const float total = shares(at, scratch);
    const std::span<const float> share_of = scratch.values();
    if (!(total > 0.0f) || total == infinity) return std::nullopt;

    // The last light that shines catches what rounding leaves over at the end.
    std::size_t chosen = 0;
    float below = 0.0f;
    for (std::size_t i = 0; i < share_of.size(); ++i) {
        if (!(share_of[i] > 0.0f)) continue;
        chosen = i;
        below += share_of[i];
        if (u.x * total < below) break;
    }
    u.x = std::clamp((u.x * total - (below - share_of[chosen])) / share_of[chosen], 0.0f, 0x1.fffffep-1f);

    const std::size_t first_portal = infinite_.size() + tree_.tops().size();
    std::optional<LightTree::Choice> lamp;
    const auto given_by = [&](const LightNode& node) { return given(node, at); };
    if (chosen >= infinite_.size() && chosen < first_portal) {
        lamp = tree_.choose(tree_.tops()[chosen - infinite_.size()], u.x, given_by);
        if (!lamp) return std::nullopt;
        u.x = lamp->u;
    }
    const float probability = lamp ? lamp->probability : 1.0f;
    std::optional<DirectionSample> sampled;
    if (chosen < infinite_.size()) {
        sampled = std::visit([&](const auto& light) { return light.sample(u); }, infinite_[chosen]);
    } else if (chosen >= first_portal) {
        sampled = portals_[chosen - first_portal].sample(p, u);
    } else if (lamp->lamp.kind == LightNode::Kind::point) {
        const FromPoint point = seen_from(p, points_[lamp->lamp.number]);
        if (!(share_of[chosen] / total * probability > 0.0f)) return std::nullopt;
        return LightSample{point.direction, point.distance, point.irradiance, share_of[chosen] / total * probability,
                           OfPointLight{lamp->lamp.number}};
    } else {
        sampled = std::visit([&](const auto& light) { return light.sample(p, u); }, area_[lamp->lamp.number]);
    }
    if (!sampled) return std::nullopt;
    const glm::vec3 wi = sampled->direction;

    // What is seen there, and how densely all lights together propose it.
    float density = share_of[chosen] / total * probability * sampled->pdf;
    for (std::size_t i = 0; i < infinite_.size(); ++i) {
        if (i != chosen && share_of[i] > 0.0f)
            density += share_of[i] / total * std::visit([&](const auto& light) { return light.pdf(wi); }, infinite_[i]);
    }
    density += portals_pdf(p, wi, share_of, chosen) / total;
    std::optional<Emission> nearest;  // of the area lights
    bool is_met = !lamp;
    tree_.for_each_near(p, wi, given_by, [&](std::uint32_t number, std::size_t top, float of_way) {
        std::visit(
            [&](const auto& light) {
                const auto distance = light.intersect(p, wi);
                if (!distance) return;
                if (!nearest || *distance < nearest->distance)
                    nearest = Emission{*distance, light.radiance(), OfAreaLight{number}};
                const float share = share_of[infinite_.size() + top];
                if (lamp && lamp->lamp.number == number)
                    is_met = true;
                else if (share * of_way > 0.0f)
                    density += share / total * of_way * light.pdf_at(p, wi, *distance);
            },
            area_[number]);
    });
    // At the very rim of a light rounding can put the direction just outside.
    if (!is_met || !(density > 0.0f)) return std::nullopt;
    if (nearest) return LightSample{wi, nearest->distance, nearest->radiance, density, nearest->source};
    return LightSample{wi, infinity, infinite_radiance(wi), density, InfiniteLights{}};
}

glm::vec3 Lights::direction_to(const LightNode& node, const glm::vec3& p) const {
    if (node.kind == LightNode::Kind::point) return seen_from(p, points_[node.number]).direction;
    if (node.kind == LightNode::Kind::group) return glm::normalize(tree_.sphere(node.number).centre - p);
    const glm::vec2 middle(0.5f);
    return std::visit([&](const auto& light) { return light.sample(p, middle).direction; }, area_[node.number]);
}

std::optional<glm::vec3> Lights::towards_brightest(const glm::vec3& p, const glm::vec3& normal) const {
    Scratch scratch(size());
    shares(p, scratch);
    std::optional<glm::vec3> brightest;
    float most = 0.0f;
    const auto consider = [&](float share, const auto& direction_of) {
        if (!(share > most)) return false;
        const std::optional<glm::vec3> direction = direction_of();
        if (!direction || !(glm::dot(*direction, normal) > 0.0f)) return false;
        most = share;
        brightest = direction;
        return true;
    };
    for (std::size_t i = 0; i < infinite_.size(); ++i)
        consider(scratch.values()[i],
                 [&] { return std::visit([](const auto& light) { return light.centre_direction(); }, infinite_[i]); });
    std::optional<LightNode> node;
    for (std::size_t i = 0; i < tree_.tops().size(); ++i) {
        const LightNode top = tree_.tops()[i];
        const float share = scratch.values()[infinite_.size() + i];
        if (consider(share, [&] { return std::optional(direction_to(top, p)); })) node = top;
    }
    // From a group down to the brighter member of each.
    while (node && node->kind == LightNode::Kind::group) {
        std::optional<LightNode> next;
        most = 0.0f;
        for (const LightNode& member : tree_.members(node->number))
            if (consider(given(member, p), [&] { return std::optional(direction_to(member, p)); })) next = member;
        if (!next) return std::nullopt;
        node = next;
    }
    return brightest;
}

std::optional<Lights::Emission> Lights::area_light_seen(const glm::vec3& origin, const glm::vec3& direction,
                                                        float geometry, bool camera_ray) const {
    std::optional<Emission> nearest;
    tree_.for_each_near(origin, direction, [&](std::uint32_t number) {
        std::visit(
            [&](const auto& light) {
                if (camera_ray && !light.visible_to_camera()) return;
                const auto distance = light.intersect(origin, direction);
                if (distance && *distance < (nearest ? nearest->distance : geometry))
                    nearest = Emission{*distance, light.radiance(), OfAreaLight{number}};
            },
            area_[number]);
    });
    return nearest;
}

std::optional<Lights::Emission> Lights::seen(const glm::vec3& origin, const glm::vec3& direction, float geometry,
                                             bool camera_ray) const {
    const std::optional<Emission> nearest = area_light_seen(origin, direction, geometry, camera_ray);
    if (nearest || geometry < infinity) return nearest;
    if (camera_ray && background_) return Emission{infinity, *background_, Background{}};
    return Emission{infinity, infinite_radiance(direction), InfiniteLights{}};
}

glm::vec3 Lights::infinite_radiance(const glm::vec3& direction) const {
    glm::vec3 sum(0.0f);
    for (const InfiniteLight& any : infinite_) {
        sum += std::visit([&](const auto& light) { return light.radiance(direction); }, any);
    }
    return sum;
}

}  // namespace phasetree::tracer
