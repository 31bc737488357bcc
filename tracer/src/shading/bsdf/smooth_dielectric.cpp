#include "shading/bsdf/smooth_dielectric.hpp"

#include "shading/fresnel.hpp"

namespace phasetree::tracer {

float radiance_factor(float ior_from, float ior_to) {
    const double ratio = static_cast<double>(ior_from) / static_cast<double>(ior_to);
    return static_cast<float>(ratio * ratio);
}

SmoothDielectricBsdf::SmoothDielectricBsdf(float ior_from, float ior_to)
    : eta_(ior_to / ior_from), radiance_factor_(radiance_factor(ior_from, ior_to)) {}

std::optional<BsdfSample> SmoothDielectricBsdf::sample(const glm::vec3& wo, float u_lobe, const glm::vec2&) const {
    if (!(wo.z > 0.0f)) return std::nullopt;
    if (passes_through()) return BsdfSample{-wo, glm::vec3{1.0f}, 1.0f, true, true};
    const auto [reflectance, cos_transmitted] = fresnel_dielectric(wo.z, eta_);
    if (u_lobe < reflectance) {
        return BsdfSample{{-wo.x, -wo.y, wo.z}, glm::vec3{1.0f}, reflectance, true, false};
    }
    return BsdfSample{
        {-wo.x / eta_, -wo.y / eta_, -cos_transmitted}, glm::vec3{radiance_factor_}, 1.0f - reflectance, true, true};
}

}  // namespace phasetree::tracer
