#include "shading/bsdf/principled_base.hpp"

#include <cmath>
#include <glm/common.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

PrincipledBase::PrincipledBase(const Kind& kind, const DielectricLayer::At& gloss, const ConductorSurface* metal)
    : metalness_(metal ? kind.metalness : 0.0f),
      roughness_(kind.roughness),
      gloss_(gloss),
      diffuse_(gloss, kind.color, metalness_ < 1.0f ? kind.diffuse_roughness : 0.0f),
      surface_(metal),
      place_(kind.metal) {
    if (metalness_ > 0.0f && kind.roughness > 0.0f) metal_.emplace(*metal, kind.roughness, place_);
}

glm::vec3 PrincipledBase::albedo(const glm::vec3& wo) const {
    glm::vec3 sum(0.0f);
    if (metalness_ > 0.0f) sum += metalness_ * metal_fresnel(wo.z);
    if (metalness_ < 1.0f) {
        const glm::vec3 gloss = gloss_.reflected(wo);
        sum += (1.0f - metalness_) * (gloss + (1.0f - gloss) * diffuse_.color());
    }
    return sum;
}

float PrincipledBase::apparent_roughness() const {
    const float perceived = std::sqrt(roughness_);
    const float gloss = is_metal() ? 0.0f : mean_of_channels(gloss_.fresnel(1.0f));
    return glm::mix(glm::mix(1.0f, perceived, gloss), perceived, metalness_);
}

PrincipledBase::Choice PrincipledBase::choice(const glm::vec3& wo) const {
    if (is_metal()) return {};
    const glm::vec3 reflected = gloss_.reflected(wo);
    const float gloss = (1.0f - metalness_) * mean_of_channels(reflected);
    const float diffuse = (1.0f - metalness_) * mean_of_channels((1.0f - reflected) * diffuse_.color());
    const float metal = metalness_ > 0.0f ? metalness_ * mean_of_channels(metal_fresnel(wo.z)) : 0.0f;
    const float sum = gloss + diffuse + metal;
    if (!(sum > 0.0f)) return {0.0f, 0.0f, true};
    // Without metal, the rest must be exactly nothing.
    return {gloss / sum, metal > 0.0f ? diffuse / sum : 1.0f - gloss / sum, false};
}

std::optional<BsdfSample> PrincipledBase::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const Choice odds = choice(wo);
    if (odds.is_black) return std::nullopt;
    const float specular = odds.gloss, scattered = specular + odds.diffuse;
    const auto mirrored = [&](const glm::vec3& reflected, float probability) {
        return BsdfSample{{-wo.x, -wo.y, wo.z}, reflected / probability, probability, true, false};
    };
    glm::vec3 wi;
    if (u_lobe < specular) {
        if (is_smooth()) return mirrored((1.0f - metalness_) * gloss_.fresnel(wo.z), odds.gloss);
        wi = gloss_.sample(wo, u);
    } else if (u_lobe < scattered) {
        wi = square_to_cosine_hemisphere(u);
    } else {
        const float probability = 1.0f - scattered;
        if (!metal_) return mirrored(metalness_ * metal_fresnel(wo.z), probability);
        const auto sample = metal_->sample(wo, stretched(u_lobe, scattered, 1.0f), u);
        if (!sample) return std::nullopt;
        wi = sample->wi;
    }
    if (!(wi.z > 0.0f)) return std::nullopt;
    const float density = pdf(wo, wi);
    if (!(density > 0.0f)) return std::nullopt;
    return BsdfSample{wi, evaluate(wo, wi) / density, density, false, false};
}

glm::vec3 PrincipledBase::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return glm::vec3(0.0f);
    glm::vec3 sum(0.0f);
    if (metal_) sum += metalness_ * metal_->evaluate(wo, wi);
    if (is_metal()) return sum;
    sum += (1.0f - metalness_) * diffuse_.evaluate(gloss_, wo, wi);
    if (!is_smooth()) sum += (1.0f - metalness_) * gloss_.evaluate(wo, wi);
    return sum;
}

float PrincipledBase::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return 0.0f;
    const Choice odds = choice(wo);
    if (odds.is_black) return 0.0f;
    float sum = odds.diffuse * cosine_hemisphere_pdf(wi.z);
    if (!is_smooth() && odds.gloss > 0.0f) sum += odds.gloss * gloss_.pdf(wo, wi);
    if (metal_) sum += (1.0f - odds.gloss - odds.diffuse) * metal_->pdf(wo, wi);
    return sum;
}

}  // namespace phasetree::tracer
