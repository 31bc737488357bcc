#include "integrator/light_proposal.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

namespace {

// Almost no light enters at smaller cosines (closer to grazing), and the pdf is unbounded there.
constexpr float least_cosine = 1e-4f;

// Refracts a direction outside the medium into it. The normal points outward.
std::optional<glm::vec3> bent_inward(const glm::vec3& outside, const glm::vec3& normal, float eta) {
    const float cosine = glm::dot(normal, outside);
    const float squared = 1.0f - (1.0f - cosine * cosine) / (eta * eta);
    if (!(cosine > least_cosine) || !(squared > 0.0f)) return std::nullopt;
    return glm::normalize((outside - normal * cosine) / eta + normal * std::sqrt(squared));
}

// Refracts a direction in the medium to the outside. `widening` is dω'/dω.
struct Outside {
    glm::vec3 direction;
    float widening;
};
std::optional<Outside> bent_outward(const glm::vec3& inside, const glm::vec3& normal, float eta) {
    const float cosine = glm::dot(normal, inside);
    const float squared = 1.0f - (1.0f - cosine * cosine) * (eta * eta);
    if (!(cosine > 0.0f) || !(squared > least_cosine * least_cosine)) return std::nullopt;
    const float after = std::sqrt(squared);
    return Outside{glm::normalize((inside - normal * cosine) * eta + normal * after), eta * eta * cosine / after};
}

// The pdf of directions inside that correspond to directions sampled towards the lights outside.
float bent_pdf(const Lights& lights, const LightReceiver& at, const glm::vec3& inside, const glm::vec3& normal,
               float eta) {
    const std::optional<Outside> outside = bent_outward(inside, normal, eta);
    return outside ? lights.pdf(at, outside->direction) * outside->widening : 0.0f;
}

// Follows a line to the first boundary beyond which the index is 1, and returns its outward normal.
std::optional<glm::vec3> boundary_along(const glm::vec3& line, const Surface& surface, const World& world,
                                        const Scene& scene, PathCounters& counters) {
    constexpr int max_interfaces = 8;
    Ray ray = surface.reflected(line);
    for (int i = 0; i < max_interfaces; ++i) {
        const Visibility met = world.geometry().visibility(ray, Bounds::infinity, counters);
        const Surface* interface = std::get_if<Surface>(&met);
        if (!interface) break;
        ray = interface->transmitted(line);
        if (std::get<Clear>(scene.materials[ray.phase.index]).ior == 1.0f) return -interface->normal;
    }
    return std::nullopt;
}

}  // namespace

LightProposal LightProposal::at(const Surface& surface, const World& world, const Scene& scene, PathCounters& counters,
                                const Wavelengths* wavelengths) {
    const glm::vec3& p = surface.near_side.origin;
    const float eta = std::get<Clear>(scene.materials[surface.near_side.phase.index]).ior_for(wavelengths);
    const glm::vec3& normal = surface.geometric_normal;
    if (eta == 1.0f) return {{p, surface.normal}, normal, eta};
    // The search direction is refracted as by a plane parallel to the surface.
    const glm::vec3 lamp = scene.lights.towards_brightest(p, normal).value_or(normal);
    const std::optional<glm::vec3> line = bent_inward(lamp, normal, eta);
    const std::optional<glm::vec3> met = line ? boundary_along(*line, surface, world, scene, counters) : std::nullopt;
    LightProposal proposal(p, met.value_or(normal), eta);
    proposal.add_flat_boundaries(world, [&](const glm::vec3&) { return std::optional(lamp); });
    return proposal;
}

LightProposal LightProposal::at(const MediumPoint& point, const std::optional<glm::vec3>& last_boundary_normal,
                                const World& world, const Scene& scene, const Wavelengths* wavelengths) {
    const float eta = std::get<Clear>(scene.materials[point.phase.index]).ior_for(wavelengths);
    LightProposal proposal(point.position, last_boundary_normal.value_or(glm::vec3(0.0f)), eta);
    if (eta == 1.0f) return proposal;
    if (!last_boundary_normal) proposal.planes_ = 0;
    proposal.add_flat_boundaries(
        world, [&](const glm::vec3& outward) { return scene.lights.towards_brightest(point.position, outward); });
    return proposal;
}

template <class LampAbove>
void LightProposal::add_flat_boundaries(const World& world, LampAbove&& lamp_above) {
    for (const FlatBoundary& flat : world.flat_boundaries()) {
        const std::optional<glm::vec3> lamp = lamp_above(flat.normal);
        const std::optional<glm::vec3> by = lamp ? bent_inward(*lamp, flat.normal, eta_) : std::nullopt;
        const float away = by ? glm::dot(flat.lit.centre() - at_.p, flat.normal) / glm::dot(*by, flat.normal) : 0.0f;
        if (away > 0.0f && flat.lit.contains(at_.p + away * *by)) add_plane(flat.normal);
    }
}

void LightProposal::add_plane(const glm::vec3& outward) {
    const auto at = static_cast<std::size_t>(planes_);
    const auto is_like = [&](const glm::vec3& plane) { return glm::dot(plane, outward) > same_normal_cosine; };
    if (at == outward_.size() || std::ranges::any_of(std::span(outward_).first(at), is_like)) return;
    outward_[at] = outward;
    ++planes_;
}

std::optional<LightSample> LightProposal::sample(const Lights& lights, glm::vec2 u,
                                                 const Wavelengths* wavelengths) const {
    const float scaled = u.x * static_cast<float>(1 + planes_);
    const int by = std::min(static_cast<int>(scaled), planes_);  // 0: straight; otherwise: through one of the planes
    u.x = std::min(scaled - static_cast<float>(by), 1 - 0x1p-24f);
    std::optional<LightSample> sample = lights.sample(at_, u, wavelengths);
    if (!sample) return std::nullopt;
    if (sample->is_of_point_light()) {
        // Once a plane has refracted the direction to a point light, the direction misses the light. So only the
        // directions that go straight to it sample a point light.
        sample->pdf /= static_cast<float>(1 + planes_);
        return by == 0 ? sample : std::nullopt;
    }
    if (by == 0) {
        sample->pdf = pdf(lights, sample->wi, sample->pdf);
        return sample;
    }
    const glm::vec3& normal = outward_[static_cast<std::size_t>(by - 1)];
    const std::optional<glm::vec3> inside = bent_inward(sample->wi, normal, eta_);
    const std::optional<Outside> outside = inside ? bent_outward(*inside, normal, eta_) : std::nullopt;
    // At the rim of a light, refracting the direction in and out again can move it just outside of the light, where the
    // pdf is that of the sky and far below that of the sample. Such a sample would have far too high a weight.
    if (!outside || !(lights.pdf(at_, outside->direction) > 0.5f * sample->pdf)) return std::nullopt;
    const auto seen = lights.seen(at_.p, *inside, Bounds::infinity, false, wavelengths);
    if (!seen) return std::nullopt;
    return LightSample{*inside, seen->distance, seen->radiance, pdf(lights, *inside), seen->source};
}

float LightProposal::pdf(const Lights& lights, const glm::vec3& direction) const {
    return pdf(lights, direction, lights.pdf(at_, direction));
}

float LightProposal::pdf_from(const Lights& lights, const glm::vec3& place, const glm::vec3& direction) const {
    LightProposal there = *this;
    there.at_.p = place;
    return there.pdf(lights, direction);
}

float LightProposal::pdf(const Lights& lights, const glm::vec3& direction, float straight) const {
    float sum = straight;
    for (int i = 0; i < planes_; ++i)
        sum += bent_pdf(lights, at_, direction, outward_[static_cast<std::size_t>(i)], eta_);
    return sum / static_cast<float>(1 + planes_);
}

}  // namespace phasetree::tracer
