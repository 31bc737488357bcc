#include "shading/bsdf/rough_conductor.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

RoughConductorBsdf::RoughConductorBsdf(const ConductorSurface& surface, float roughness,
                                       const ConductorSurface::Place& place)
    : surface_(&surface),
      ggx_(surface.microfacets(roughness)),
      place_(place),
      multiple_(surface.multiple(roughness, place)) {}

RoughConductorBsdf::Scattered RoughConductorBsdf::scattered(const glm::vec3& wo, const glm::vec3& wi,
                                                            const glm::vec3& m) const {
    const float cos_o = glm::dot(wo, m);
    const float lost = multiple_.losses.at(wo).x;
    const float average = std::max(multiple_.losses.average().x, 1e-30f);
    const float once = 0.25f * ggx_.distribution(m) * ggx_.reflection_visibility(wo, wi) * wi.z;
    const float again = lost * multiple_.losses.at(wi).x / average * cosine_hemisphere_pdf(wi.z);
    return {surface_->fresnel(cos_o, place_) * once + multiple_.reflected * again,
            (1.0f - lost) * ggx_.visible_normal_pdf(wo, m) / (4.0f * cos_o) + lost * multiple_.losses.pdf(wi.z)};
}

std::optional<BsdfSample> RoughConductorBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    glm::vec3 m, wi;
    if (u_lobe < multiple_.losses.at(wo).x) {
        wi = multiple_.losses.sample(u);
        m = glm::normalize(wo + wi);
    } else {
        m = ggx_.sample_visible_normal(wo, u);
        const float cos_o = glm::dot(wo, m);
        if (!(cos_o > 0.0f)) return std::nullopt;
        wi = 2.0f * cos_o * m - wo;
        if (!(wi.z > 0.0f)) return std::nullopt;
    }
    const Scattered all = scattered(wo, wi, m);
    if (!(all.pdf > 0.0f)) return std::nullopt;
    return BsdfSample{wi, all.value / all.pdf, all.pdf, false, false};
}

glm::vec3 RoughConductorBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return glm::vec3{0.0f};
    return scattered(wo, wi, glm::normalize(wo + wi)).value;
}

float RoughConductorBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return 0.0f;
    return scattered(wo, wi, glm::normalize(wo + wi)).pdf;
}

}  // namespace phasetree::tracer
