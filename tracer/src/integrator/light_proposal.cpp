#include "integrator/light_proposal.hpp"

#include <cmath>
#include <limits>

namespace phasetree::tracer {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Nearer to grazing next to no light comes in, and densities are endless.
constexpr float least_cosine = 1e-4f;

// A direction outside, as it goes on inside. The normal is on its side.
std::optional<glm::vec3> bent_inward(const glm::vec3& outside, const glm::vec3& normal, float eta) {
    const float cosine = glm::dot(normal, outside);
    const float squared = 1.0f - (1.0f - cosine * cosine) / (eta * eta);
    if (!(cosine > least_cosine) || !(squared > 0.0f)) return std::nullopt;
    return glm::normalize((outside - normal * cosine) / eta + normal * std::sqrt(squared));
}

// And back, with dω'/dω.
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

}  // namespace

LightProposal LightProposal::at(const Surface& surface, const World& world, const Scene& scene,
                                PathCounters& counters) {
    const auto ior = [&](Phase phase) { return std::get<Clear>(scene.materials[phase.index]).ior; };
    LightProposal proposal(surface.near_origin, surface.normal, ior(surface.near_phase));
    if (proposal.eta_ == 1.0f) return proposal;
    // The first guess is a plane parallel to the surface; the second, where the line that this makes leaves the last
    // medium that bends light.
    const glm::vec3 lamp = scene.lights.towards_brightest(proposal.p_, proposal.outward_);
    const std::optional<glm::vec3> line = bent_inward(lamp, proposal.outward_, proposal.eta_);
    if (!line) return proposal;
    constexpr int most_interfaces = 8;
    glm::vec3 origin = surface.near_origin;
    Phase phase = surface.near_phase;
    Start start = surface.start;
    for (int i = 0; i < most_interfaces; ++i) {
        const auto met = world.intersect(origin, *line, infinity, phase, start, Purpose::light, counters);
        if (!met || !met->optics) break;
        phase = met->far_phase;
        if (ior(phase) == 1.0f) {
            proposal.outward_ = -met->normal;
            break;
        }
        origin = met->far_origin;
        start = met->start;
    }
    return proposal;
}

std::optional<LightSample> LightProposal::sample(const Lights& lights, glm::vec2 u) const {
    if (eta_ == 1.0f) return lights.sample(p_, u);
    const bool is_bent = u.x >= 0.5f;
    u.x = 2.0f * u.x - (is_bent ? 1.0f : 0.0f);
    std::optional<LightSample> sample = lights.sample(p_, u);
    if (!sample) return std::nullopt;
    if (!is_bent) {
        sample->pdf = 0.5f * (sample->pdf + bent_pdf(lights, sample->wi));
        return sample;
    }
    const std::optional<glm::vec3> inside = bent_inward(sample->wi, outward_, eta_);
    const std::optional<Outside> outside = inside ? bent_outward(*inside, outward_, eta_) : std::nullopt;
    // At the very rim of a light rounding can put the direction just outside, where it is said to be much rarer.
    if (!outside || !(lights.pdf(p_, outside->direction) > 0.5f * sample->pdf)) return std::nullopt;
    const auto seen = lights.seen(p_, *inside, infinity, false);
    if (!seen) return std::nullopt;
    return LightSample{*inside, seen->distance, seen->radiance, pdf(lights, *inside)};
}

float LightProposal::pdf(const Lights& lights, const glm::vec3& direction) const {
    const float straight = lights.pdf(p_, direction);
    return eta_ == 1.0f ? straight : 0.5f * (straight + bent_pdf(lights, direction));
}

float LightProposal::bent_pdf(const Lights& lights, const glm::vec3& direction) const {
    const std::optional<Outside> outside = bent_outward(direction, outward_, eta_);
    return outside ? lights.pdf(p_, outside->direction) * outside->widening : 0.0f;
}

}  // namespace phasetree::tracer
