#include "shading/bsdf/smooth_dielectric.hpp"

#include "shading/bsdf/lobes.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer {

SmoothDielectricBsdf::SmoothDielectricBsdf(float ior_from, float ior_to)
    : eta_(ior_to / ior_from), radiance_factor_(radiance_factor(ior_from, ior_to)) {}

SmoothDielectricBsdf::SmoothDielectricBsdf(const DielectricSurface& surface, float thickness,
                                           const Wavelengths* wavelengths)
    : eta_(surface.eta()),
      radiance_factor_(surface.radiance_factor()),
      film_(surface.has_film() ? &surface : nullptr),
      thickness_(thickness),
      wavelengths_(wavelengths) {}

std::optional<BsdfSample> SmoothDielectricBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2&) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    if (passes_through()) return BsdfSample{-wo, glm::vec3{1.0f}, 1.0f, true, true};
    const auto reflected = [&](const glm::vec3& weight, float pdf) {
        return BsdfSample{{-wo.x, -wo.y, wo.z}, weight, pdf, true, false};
    };
    const auto refracted = [&](float cosine, const glm::vec3& weight, float pdf) {
        return BsdfSample{{-wo.x / eta_, -wo.y / eta_, -cosine}, weight * radiance_factor_, pdf, true, true};
    };
    if (film_ == nullptr) {
        const auto [reflectance, cos_transmitted] = fresnel_dielectric(wo.z, eta_);
        if (u_lobe < reflectance) return reflected(glm::vec3{1.0f}, reflectance);
        return refracted(cos_transmitted, glm::vec3{1.0f}, 1.0f - reflectance);
    }
    const auto [reflectance, cos_transmitted] = film_->fresnel(wo.z, thickness_, wavelengths_);
    const float chosen = mean_of_channels(reflectance);
    if (u_lobe < chosen) return reflected(reflectance / chosen, chosen);
    return refracted(cos_transmitted, (1.0f - reflectance) / (1.0f - chosen), 1.0f - chosen);
}

}  // namespace phasetree::tracer
