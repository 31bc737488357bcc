#include "shading/bsdf/rough_dielectric.hpp"

#include <glm/geometric.hpp>

#include "shading/bsdf/smooth_dielectric.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer {

RoughDielectricBsdf::RoughDielectricBsdf(float ior_from, float ior_to, float roughness)
    : ggx_(roughness), eta_(ior_to / ior_from), radiance_factor_(radiance_factor(ior_from, ior_to)) {}

std::optional<glm::vec3> RoughDielectricBsdf::microfacet(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || wi.z == 0.0f) return std::nullopt;
    const bool transmitted = wi.z < 0.0f;
    glm::vec3 half = transmitted ? wo + eta_ * wi : wo + wi;
    const float length = glm::length(half);
    if (!(length > 0.0f)) return std::nullopt;
    half *= (half.z < 0.0f ? -1.0f : 1.0f) / length;
    if (!(half.z > 0.0f)) return std::nullopt;
    // Both directions must see the same side (reflection) or opposite sides (transmission) of the microfacet.
    if (!(glm::dot(wo, half) > 0.0f)) return std::nullopt;
    if ((glm::dot(wi, half) < 0.0f) != transmitted) return std::nullopt;
    return half;
}

std::optional<BsdfSample> RoughDielectricBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    if (passes_through()) return BsdfSample{-wo, glm::vec3{1.0f}, 1.0f, true, true};
    const glm::vec3 m = ggx_.sample_visible_normal(wo, u);
    const float cos_o = glm::dot(wo, m);
    if (!(cos_o > 0.0f)) return std::nullopt;
    const auto [reflectance, cos_transmitted] = fresnel_dielectric(cos_o, eta_);
    const float normal_pdf = ggx_.visible_normal_pdf(wo, m);
    const float masking = ggx_.masking(wo);
    if (u_lobe < reflectance) {
        const glm::vec3 wi = 2.0f * cos_o * m - wo;
        if (!(wi.z > 0.0f)) return std::nullopt;
        const float weight = ggx_.reflection_visibility(wo, wi) * wo.z * wi.z / masking;
        return BsdfSample{wi, glm::vec3{weight}, reflectance * normal_pdf / (4.0f * cos_o), false, false};
    }
    const glm::vec3 wi = (cos_o / eta_ - cos_transmitted) * m - wo / eta_;
    if (!(wi.z < 0.0f)) return std::nullopt;
    const float denominator = cos_o - eta_ * cos_transmitted;
    const float jacobian = eta_ * eta_ * cos_transmitted / (denominator * denominator);
    return BsdfSample{wi, glm::vec3{radiance_factor_ * ggx_.masking(wi)}, (1.0f - reflectance) * normal_pdf * jacobian,
                      false, true};
}

glm::vec3 RoughDielectricBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (passes_through()) return glm::vec3{0.0f};
    const std::optional<glm::vec3> m = microfacet(wo, wi);
    if (!m) return glm::vec3{0.0f};
    const float cos_o = glm::dot(wo, *m);
    const float reflectance = fresnel_dielectric(cos_o, eta_).reflectance;
    const float distribution = ggx_.distribution(*m);
    if (wi.z > 0.0f) {
        return glm::vec3{0.25f * reflectance * distribution * ggx_.reflection_visibility(wo, wi) * wi.z};
    }
    const float cos_i = glm::dot(wi, *m);
    const float denominator = cos_o + eta_ * cos_i;
    return glm::vec3{(1.0f - reflectance) * distribution * ggx_.transmission_visibility(wo, wi) * cos_o * -cos_i *
                     -wi.z / (denominator * denominator)};
}

float RoughDielectricBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (passes_through()) return 0.0f;
    const std::optional<glm::vec3> m = microfacet(wo, wi);
    if (!m) return 0.0f;
    const float cos_o = glm::dot(wo, *m);
    const float reflectance = fresnel_dielectric(cos_o, eta_).reflectance;
    const float normal_pdf = ggx_.visible_normal_pdf(wo, *m);
    if (wi.z > 0.0f) return reflectance * normal_pdf / (4.0f * cos_o);
    const float cos_i = glm::dot(wi, *m);
    const float denominator = cos_o + eta_ * cos_i;
    return (1.0f - reflectance) * normal_pdf * eta_ * eta_ * -cos_i / (denominator * denominator);
}

}  // namespace phasetree::tracer
