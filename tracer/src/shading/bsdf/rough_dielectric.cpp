#include "shading/bsdf/rough_dielectric.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

RoughDielectricBsdf::RoughDielectricBsdf(const DielectricSurface& surface, float roughness,
                                         const Wavelengths* wavelengths)
    : surface_(&surface),
      wavelengths_(surface.has_film() ? wavelengths : nullptr),
      ggx_(roughness),
      eta_(surface.eta()),
      multiple_(surface.multiple(roughness)),
      transmitted_(mean_of_channels(multiple_.transmitted)),
      transmitted_back_(mean_of_channels(multiple_.transmitted_back)) {}

std::optional<glm::vec3> RoughDielectricBsdf::microfacet(const glm::vec3& wo, const glm::vec3& wi) const {
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

RoughDielectricBsdf::Scattered RoughDielectricBsdf::once(const glm::vec3& wo, const glm::vec3& wi,
                                                         const glm::vec3& m) const {
    const float cos_o = glm::dot(wo, m);
    const glm::vec3 reflectance = surface_->fresnel(cos_o, surface_->middle_thickness()).reflectance;
    const float chosen = mean_of_channels(reflectance);
    const float normal_pdf = ggx_.visible_normal_pdf(wo, m);
    const float distribution = ggx_.distribution(m);
    if (wi.z > 0.0f) {
        return {reflectance * (0.25f * distribution * ggx_.reflection_visibility(wo, wi) * wi.z),
                chosen * normal_pdf / (4.0f * cos_o)};
    }
    const float cos_i = -glm::dot(wi, m);
    const float denominator = cos_o - eta_ * cos_i;
    const float squared = denominator * denominator;
    return {
        (1.0f - reflectance) * (distribution * ggx_.transmission_visibility(wo, wi) * cos_o * cos_i * -wi.z / squared),
        (1.0f - chosen) * normal_pdf * eta_ * eta_ * cos_i / squared};
}

RoughDielectricBsdf::Scattered RoughDielectricBsdf::scattered(const glm::vec3& wo, const glm::vec3& wi,
                                                              const std::optional<glm::vec3>& m) const {
    const glm::vec3 lost = multiple_.from.at(wo.z);
    const float again = mean_of_channels(lost);
    const bool is_transmitted = wi.z < 0.0f;
    const float cosine = std::abs(wi.z);
    const LossTables::At& side = is_transmitted ? multiple_.to : multiple_.from;
    Scattered sum;
    if (again > 0.0f) {
        const glm::vec3 part =
            is_transmitted ? multiple_.transmitted * surface_->radiance_factor() : 1.0f - multiple_.transmitted;
        const glm::vec3 average = glm::max(side.average(), glm::vec3(1e-30f));
        sum.value = part * lost * side.at(cosine) / average * cosine_hemisphere_pdf(cosine);
        sum.pdf = again * (is_transmitted ? transmitted_ : 1.0f - transmitted_) * side.pdf(cosine);
    }
    if (m) {
        const Scattered single = once(wo, wi, *m);
        if (std::isfinite(single.pdf)) {
            sum.value += single.value;
            sum.pdf += (1.0f - again) * single.pdf;
        }
    }
    sum.value = for_light(sum.value, wavelengths_);
    return sum;
}

std::optional<BsdfSample> RoughDielectricBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    const auto given = [&](const glm::vec3& wi, const std::optional<glm::vec3>& m) -> std::optional<BsdfSample> {
        const Scattered all = scattered(wo, wi, m);
        if (!(all.pdf > 0.0f)) return std::nullopt;
        return BsdfSample{wi, all.value / all.pdf, all.pdf, false, wi.z < 0.0f};
    };
    const float again = mean_of_channels(multiple_.from.at(wo.z));
    if (u_lobe < again) {
        const bool is_transmitted = u_lobe < again * transmitted_;
        glm::vec3 wi = (is_transmitted ? multiple_.to : multiple_.from).sample(u);
        if (is_transmitted) wi.z = -wi.z;
        return given(wi, microfacet(wo, wi));
    }
    const float lobe = stretched(u_lobe, again, 1.0f);
    const glm::vec3 m = ggx_.sample_visible_normal(wo, u);
    const float cos_o = glm::dot(wo, m);
    if (!(cos_o > 0.0f)) return std::nullopt;
    const auto [reflectance, cos_transmitted] = surface_->fresnel(cos_o, surface_->middle_thickness());
    if (lobe < mean_of_channels(reflectance)) {
        const glm::vec3 wi = 2.0f * cos_o * m - wo;
        if (!(wi.z > 0.0f)) return std::nullopt;
        return given(wi, m);
    }
    const glm::vec3 wi = (cos_o / eta_ - cos_transmitted) * m - wo / eta_;
    if (!(wi.z < 0.0f)) return std::nullopt;
    return given(wi, m);
}

glm::vec3 RoughDielectricBsdf::evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || wi.z == 0.0f) return glm::vec3{0.0f};
    return scattered(wo, wi, microfacet(wo, wi)).value;
}

float RoughDielectricBsdf::pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wo.z > 0.0f) || wi.z == 0.0f) return 0.0f;
    return scattered(wo, wi, microfacet(wo, wi)).pdf;
}

float RoughDielectricBsdf::reverse_pdf(const glm::vec3& wo, const glm::vec3& wi) const {
    if (!(wi.z < 0.0f)) return pdf(wi, wo);
    if (!(wo.z > 0.0f)) return 0.0f;
    const float again = mean_of_channels(multiple_.to.at(-wi.z));
    float sum = again * transmitted_back_ * multiple_.from.pdf(wo.z);
    if (const std::optional<glm::vec3> m = microfacet(wo, wi)) {
        // Fresnel's reflectance at the microfacet is the same from both sides. This is the pdf of once(), with 1/η for
        // η.
        const float cos_o = glm::dot(wo, *m), denominator = cos_o + eta_ * glm::dot(wi, *m);
        const float transmittance =
            1.0f - mean_of_channels(surface_->fresnel(cos_o, surface_->middle_thickness()).reflectance);
        const float single = transmittance * ggx_.visible_normal_pdf(-wi, *m) * cos_o / (denominator * denominator);
        if (std::isfinite(single)) sum += (1.0f - again) * single;
    }
    return sum;
}

}  // namespace phasetree::tracer
