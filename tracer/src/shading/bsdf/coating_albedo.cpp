#include "shading/bsdf/coating_albedo.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sampling/ggx.hpp"
#include "sampling/sobol.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer {

namespace {

// Mean over visible normals of F G₂/G₁: everything the rough coating reflects in one scattering.
float rough_directional_albedo(const Ggx& ggx, float cos_theta, float eta) {
    constexpr std::uint32_t samples = 2048;
    const glm::vec3 wo{std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta)), 0.0f, cos_theta};
    double sum = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 u{static_cast<float>(sobol_first(i) >> 8) * 0x1p-24f,
                          static_cast<float>(sobol_second(i) >> 8) * 0x1p-24f};
        const glm::vec3 m = ggx.sample_visible_normal(wo, u);
        const float cos_o = glm::dot(wo, m);
        const glm::vec3 wi = 2.0f * cos_o * m - wo;
        if (!(cos_o > 0.0f) || !(wi.z > 0.0f)) continue;
        const float shadowing = ggx.reflection_visibility(wo, wi) * wo.z * wi.z / ggx.masking(wo);
        sum += static_cast<double>(fresnel_dielectric(cos_o, eta).reflectance * shadowing);
    }
    return static_cast<float>(sum / samples);
}

}  // namespace

CoatingAlbedo::CoatingAlbedo(float eta, float roughness) : eta_(eta), roughness_(roughness) {
    if (roughness_ > 0.0f) {
        const Ggx ggx(roughness_);
        for (std::size_t i = 0; i < nodes; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(nodes - 1);
            table_[i] = rough_directional_albedo(ggx, std::max(1e-4f, t * t), eta_);
        }
    }
    // Midpoint rule in t = √μ, where E is smooth up to the critical angle: dμ = 2t dt.
    constexpr int steps = 4096;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        sum += 4.0 * t * t * t * static_cast<double>(directional(static_cast<float>(t * t)));
    }
    average_ = static_cast<float>(std::clamp(sum / steps, 0.0, 1.0));
    internal_ = std::clamp(1.0f - (1.0f - average_) / (eta_ * eta_), 0.0f, 1.0f);
}

float CoatingAlbedo::directional(float cos_theta) const {
    const float mu = std::clamp(cos_theta, 0.0f, 1.0f);
    if (eta_ == 1.0f) return 0.0f;
    if (!(roughness_ > 0.0f)) return fresnel_dielectric(mu, eta_).reflectance;
    const float position = std::sqrt(mu) * static_cast<float>(nodes - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), nodes - 2);
    const float part = position - static_cast<float>(below);
    return table_[below] + part * (table_[below + 1] - table_[below]);
}

}  // namespace phasetree::tracer
