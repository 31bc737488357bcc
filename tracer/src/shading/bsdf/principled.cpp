#include "shading/bsdf/principled.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

PrincipledBsdf& PrincipledBsdf::add(const PrincipledCoat& coat, const DielectricLayer::At& layer,
                                    const PrincipledBase& coated) {
    if (coat.weight > 0.0f) coat_.emplace(coat, layer, coated);
    return *this;
}

PrincipledBsdf& PrincipledBsdf::add(const PrincipledFuzz& kind, const Fuzz& fuzz) {
    if (kind.weight > 0.0f) fuzz_.emplace(WithFuzz{kind, fuzz});
    return *this;
}

PrincipledBsdf::Coat::Coat(const PrincipledCoat& kind, const DielectricLayer::At& layer, const PrincipledBase& base)
    : kind_(kind),
      layer_(layer),
      base_(base),
      base_albedo_(base.albedo({0.0f, 0.0f, 1.0f})),
      base_roughness_(base.apparent_roughness()),
      sent_back_to_diffuse_(glm::clamp(1.0f - layer.average_entering() / (kind.eta * kind.eta), 0.0f, 1.0f)) {}

glm::vec3 PrincipledBsdf::Coat::absorption(float cosine) const {
    if (kind_.color == glm::vec3(1.0f)) return glm::vec3(1.0f);
    // Where light is totally reflected, none takes this way.
    const float refracted2 = 1.0f - (1.0f - cosine * cosine) / (kind_.eta * kind_.eta);
    if (!(refracted2 > 0.0f)) return glm::vec3(0.0f);
    const float exponent = 0.5f / std::sqrt(refracted2);
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) result[i] = std::pow(std::clamp(kind_.color[i], 0.0f, 1.0f), exponent);
    return result;
}

glm::vec3 PrincipledBsdf::Coat::to_base(const glm::vec3& wo) const {
    const glm::vec3 sent_back = glm::mix(layer_.fresnel(wo.z), sent_back_to_diffuse_, base_roughness_);
    const glm::vec3 darkened = (1.0f - sent_back) / glm::max(1.0f - base_albedo_ * sent_back, glm::vec3(1e-6f));
    const glm::vec3 darkening = glm::mix(glm::vec3(1.0f), glm::min(darkened, glm::vec3(1.0f)), kind_.darkening);
    return layer_.entering(wo) * absorption(wo.z) * darkening;
}

PrincipledBsdf::Parts PrincipledBsdf::parts_for(const glm::vec3& wo) const {
    Parts parts;
    if (!coat_ && !fuzz_) return parts;
    const float below_fuzz = fuzz_ ? 1.0f - fuzz_->reflected(wo) : 1.0f;
    const float fuzz = fuzz_ ? fuzz_->reflected(wo) * mean_of_channels(fuzz_->kind.color) : 0.0f;
    float coat = 0.0f, base = 0.0f;
    if (coat_) {
        parts.coated = below_fuzz * coat_->weight();
        parts.to_base = parts.coated * coat_->to_base(wo);
        coat = parts.coated * mean_of_channels(coat_->layer().reflected(wo));
        base = mean_of_channels(parts.to_base * coat_->base().albedo(wo));
    }
    parts.bare = below_fuzz - parts.coated;
    const float bare = parts.bare > 0.0f ? parts.bare * mean_of_channels(bare_.albedo(wo)) : 0.0f;
    const float sum = fuzz + coat + base + bare;
    if (!(sum > 0.0f)) {
        parts.is_black = true;
        return parts;
    }
    parts.choose_fuzz = fuzz / sum;
    parts.choose_coat = coat / sum;
    // Without a bare part, the rest must be exactly nothing.
    parts.choose_base = bare > 0.0f ? base / sum : 1.0f - parts.choose_fuzz - parts.choose_coat;
    return parts;
}

std::optional<BsdfSample> PrincipledBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const Parts parts = parts_for(wo);
    if (parts.is_black) return std::nullopt;
    const float above_fuzz = parts.choose_fuzz, above_coat = above_fuzz + parts.choose_coat;
    const float above_base = above_coat + parts.choose_base;
    // A sample of a base, as one of the whole surface if it is specular.
    const auto of_base = [&](const PrincipledBase& base, float low, float high, const glm::vec3& share) {
        auto sample = base.sample(wo, stretched(u_lobe, low, high), u);
        if (!sample || !sample->delta) return sample;
        sample->weight *= share / (high - low);
        sample->pdf *= high - low;
        return sample;
    };
    glm::vec3 wi;
    if (u_lobe < above_fuzz) {
        wi = Fuzz::sample(u);
    } else if (u_lobe < above_coat) {
        const DielectricLayer::At& layer = coat_->layer();
        if (layer.is_smooth())
            return BsdfSample{{-wo.x, -wo.y, wo.z},
                              parts.coated * layer.fresnel(wo.z) / parts.choose_coat,
                              parts.choose_coat,
                              true,
                              false};
        wi = layer.sample(wo, u);
    } else {
        const bool is_coated = u_lobe < above_base;
        const auto sample =
            is_coated ? of_base(coat_->base(), above_coat, above_base, parts.to_base * coat_->absorption(wo.z))
                      : of_base(bare_, above_base, 1.0f, glm::vec3(parts.bare));
        if (!sample || sample->delta) return sample;
        wi = sample->wi;
    }
    if (!(wi.z > 0.0f)) return std::nullopt;
    const float density = pdf(parts, wo, wi);
    if (!(density > 0.0f)) return std::nullopt;
    return BsdfSample{wi, evaluate(parts, wo, wi) / density, density, false, false};
}

glm::vec3 PrincipledBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return glm::vec3(0.0f);
    return evaluate(parts_for(wo), wo, wi);
}

glm::vec3 PrincipledBsdf::evaluate(const Parts& parts, const glm::vec3& wo, const glm::vec3& wi) const {
    glm::vec3 sum(0.0f);
    if (parts.bare > 0.0f) sum += parts.bare * bare_.evaluate(wo, wi);
    if (coat_) {
        sum += parts.to_base * coat_->absorption(wi.z) * coat_->base().evaluate(wo, wi);
        const DielectricLayer::At& layer = coat_->layer();
        if (!layer.is_smooth()) sum += parts.coated * layer.evaluate(wo, wi);
    }
    if (fuzz_) sum += fuzz_->kind.color * (fuzz_->kind.weight * fuzz_->fuzz.evaluate(wo, wi));
    return sum;
}

float PrincipledBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return 0.0f;
    return pdf(parts_for(wo), wo, wi);
}

float PrincipledBsdf::pdf(const Parts& parts, const glm::vec3& wo, const glm::vec3& wi) const {
    if (parts.is_black) return 0.0f;
    float sum = parts.choose_fuzz * Fuzz::pdf();
    if (coat_) {
        sum += parts.choose_base * coat_->base().pdf(wo, wi);
        if (!coat_->layer().is_smooth()) sum += parts.choose_coat * coat_->layer().pdf(wo, wi);
    }
    if (parts.bare > 0.0f) sum += parts.choose_bare() * bare_.pdf(wo, wi);
    return sum;
}

}  // namespace phasetree::tracer
