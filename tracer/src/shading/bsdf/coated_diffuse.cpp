#include "shading/bsdf/coated_diffuse.hpp"

#include <glm/geometric.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

CoatedDiffuseBsdf::CoatedDiffuseBsdf(const CoatingAlbedo::At& coating, const glm::vec3& base_albedo)
    : coating_(coating), base_(0.0f), base_brightness_(0.0f), ggx_(coating.roughness()) {
    const glm::vec3 entering = 1.0f - coating.average();
    const glm::vec3 rho = glm::clamp(base_albedo, 0.0f, 1.0f);
    const glm::vec3 internal = coating.internal();
    glm::vec3 seen = rho * (1.0f - internal) / glm::max(glm::vec3{1.0f} - rho * internal, glm::vec3{1e-12f});
    for (int i = 0; i < 3; ++i) {
        if (!(entering[i] > 1e-6f)) seen[i] = 0.0f;  // no light reaches the base
        base_[i] = seen[i] > 0.0f ? seen[i] / entering[i] : 0.0f;
    }
    base_brightness_ = mean_of_channels(seen);
}

// Proportional to the reflectance of the two layers.
float CoatedDiffuseBsdf::coating_probability(const glm::vec3& reflected) const {
    const float coat = mean_of_channels(reflected);
    const float base = (1.0f - coat) * base_brightness_;
    return coat > 0.0f ? coat / (coat + base) : 0.0f;
}

glm::vec3 CoatedDiffuseBsdf::evaluate_base(const glm::vec3& transmitted, const glm::vec3& wi) const {
    return base_ * (transmitted * (1.0f - coating_.directional(wi.z)) * cosine_hemisphere_pdf(wi.z));
}

std::optional<BsdfSample> CoatedDiffuseBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const glm::vec3 reflected = coating_.directional(wo.z);
    const float probability = coating_probability(reflected);
    if (u_lobe < probability) {
        if (smooth()) {
            return BsdfSample{{-wo.x, -wo.y, wo.z}, reflected / probability, probability, true, false};
        }
        const glm::vec3 m = ggx_.sample_visible_normal(wo, u);
        const glm::vec3 wi = 2.0f * glm::dot(wo, m) * m - wo;
        if (!(wi.z > 0.0f)) return std::nullopt;
        const float density = pdf(wo, wi);
        if (!(density > 0.0f)) return std::nullopt;
        return BsdfSample{wi, evaluate(wo, wi) / density, density, false, false};
    }
    const glm::vec3 wi = square_to_cosine_hemisphere(u);
    if (!(wi.z > 0.0f)) return std::nullopt;
    const float density = pdf(wo, wi);
    if (!(density > 0.0f)) return std::nullopt;
    return BsdfSample{wi, evaluate(wo, wi) / density, density, false, false};
}

glm::vec3 CoatedDiffuseBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return glm::vec3{0.0f};
    glm::vec3 result = evaluate_base(1.0f - coating_.directional(wo.z), wi);
    if (!smooth()) {
        const glm::vec3 m = glm::normalize(wo + wi);
        result += coating_.fresnel(glm::dot(wo, m)) *
                  (0.25f * ggx_.distribution(m) * ggx_.reflection_visibility(wo, wi) * wi.z);
    }
    return result;
}

float CoatedDiffuseBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return 0.0f;
    const float probability = coating_probability(coating_.directional(wo.z));
    float result = (1.0f - probability) * cosine_hemisphere_pdf(wi.z);
    if (!smooth() && probability > 0.0f) {
        const glm::vec3 m = glm::normalize(wo + wi);
        result += probability * ggx_.visible_normal_pdf(wo, m) / (4.0f * glm::dot(wo, m));
    }
    return result;
}

}  // namespace phasetree::tracer
