#include "shading/bsdf/rough_thin_glass.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

namespace {

glm::vec3 mirrored(const glm::vec3& w) {
    return {w.x, w.y, -w.z};
}

}  // namespace

RoughThinGlassBsdf::RoughThinGlassBsdf(const ThinPane& pane, float roughness, const LossTables::At& losses)
    : pane_(pane), ggx_(roughness), losses_(losses), of_multiple_(pane.under_uniform_light()) {}

RoughThinGlassBsdf::Scattered RoughThinGlassBsdf::scattered(const glm::vec3& wo, const glm::vec3& wi,
                                                            bool is_transmitted) const {
    const glm::vec3 m = glm::normalize(wo + wi);
    const float cos_o = glm::dot(wo, m);
    const ThinPane::Shares of_single = pane_.at(std::min(cos_o, 1.0f));
    const float lost = losses_.at(wo).x, average = std::max(losses_.average().x, 1e-30f);
    const float once = 0.25f * ggx_.distribution(m) * ggx_.reflection_visibility(wo, wi) * wi.z;
    const float again = lost * losses_.at(wi).x / average * cosine_hemisphere_pdf(wi.z);
    const float pdf_once = (1.0f - lost) * ggx_.visible_normal_pdf(wo, m) / (4.0f * cos_o);
    const float pdf_again = lost * losses_.pdf(wi.z);
    const float once_reflected = of_single.choice_of_reflection(),
                again_reflected = of_multiple_.choice_of_reflection();
    if (is_transmitted)
        return {of_single.transmitted * once + of_multiple_.transmitted * again,
                (1.0f - once_reflected) * pdf_once + (1.0f - again_reflected) * pdf_again};
    return {of_single.reflected * once + of_multiple_.reflected * again,
            once_reflected * pdf_once + again_reflected * pdf_again};
}

std::optional<BsdfSample> RoughThinGlassBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const float lost = losses_.at(wo).x;
    glm::vec3 wi;
    float choice, u_choice;
    if (u_lobe < lost) {
        wi = losses_.sample(u);
        choice = of_multiple_.choice_of_reflection();
        u_choice = stretched(u_lobe, 0.0f, lost);
    } else {
        const glm::vec3 m = ggx_.sample_visible_normal(wo, u);
        const float cos_o = glm::dot(wo, m);
        if (!(cos_o > 0.0f)) return std::nullopt;
        wi = 2.0f * cos_o * m - wo;
        choice = pane_.at(std::min(cos_o, 1.0f)).choice_of_reflection();
        u_choice = stretched(u_lobe, lost, 1.0f);
    }
    if (!(wi.z > 0.0f)) return std::nullopt;
    const bool is_transmitted = !(u_choice < choice);
    const Scattered all = scattered(wo, wi, is_transmitted);
    if (!(all.pdf > 0.0f)) return std::nullopt;
    return BsdfSample{is_transmitted ? mirrored(wi) : wi, all.value / all.pdf, all.pdf, false, is_transmitted};
}

glm::vec3 RoughThinGlassBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || wi.z == 0.0f) return glm::vec3{0.0f};
    return scattered(wo, wi.z < 0.0f ? mirrored(wi) : wi, wi.z < 0.0f).value;
}

float RoughThinGlassBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || wi.z == 0.0f) return 0.0f;
    return scattered(wo, wi.z < 0.0f ? mirrored(wi) : wi, wi.z < 0.0f).pdf;
}

float RoughThinGlassBsdf::reverse_pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    return wi.z < 0.0f ? pdf(mirrored(wi), mirrored(wo)) : pdf(wi, wo);
}

}  // namespace phasetree::tracer
