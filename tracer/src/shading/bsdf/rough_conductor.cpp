#include "shading/bsdf/rough_conductor.hpp"

#include <glm/geometric.hpp>

#include "shading/fresnel.hpp"

namespace phasetree::tracer {

std::optional<BsdfSample> RoughConductorBsdf::sample(const glm::vec3& wo, float, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const glm::vec3 m = ggx_.sample_visible_normal(wo, u);
    const float cos_o = glm::dot(wo, m);
    if (!(cos_o > 0.0f)) return std::nullopt;
    const glm::vec3 wi = 2.0f * cos_o * m - wo;
    if (!(wi.z > 0.0f)) return std::nullopt;
    const float shadowing = ggx_.reflection_visibility(wo, wi) * wo.z * wi.z / ggx_.masking(wo);
    return BsdfSample{wi, fresnel_conductor(cos_o, eta_, k_) * shadowing,
                      ggx_.visible_normal_pdf(wo, m) / (4.0f * cos_o), false, false};
}

glm::vec3 RoughConductorBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return glm::vec3{0.0f};
    const glm::vec3 m = glm::normalize(wo + wi);
    return fresnel_conductor(glm::dot(wo, m), eta_, k_) *
           (0.25f * ggx_.distribution(m) * ggx_.reflection_visibility(wo, wi) * wi.z);
}

float RoughConductorBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return 0.0f;
    const glm::vec3 m = glm::normalize(wo + wi);
    return ggx_.visible_normal_pdf(wo, m) / (4.0f * glm::dot(wo, m));
}

}  // namespace phasetree::tracer
