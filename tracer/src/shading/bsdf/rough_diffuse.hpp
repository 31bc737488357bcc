// Clay, plaster, sandstone, dust: small diffuse facets that shadow and light each other, so that a ball looks flatter
// and brighter at its rim than a Lambertian one, like the full moon.
//
//     f = f_once + f_ms
//     f_once = ρ/π (A + r A s/t),   s = o·i − o.z i.z,   t = max(o.z, i.z) where s > 0, else 1
//     A = 1/(1 + (1/2 − 2/(3π)) r)
//
// f_once is single scattering (Fujii's form of Oren and Nayar's model), with the roughness r in [0, 1], where 0 is
// Lambert's law. By single scattering, a white surface reflects this fraction of light that arrives at an angle θ,
//     E(θ) = A + r A G(θ)/π,   G = sin θ (θ − sin θ cos θ) + 2/3 (tan θ (1 − sin³θ) − sin θ)
// and this fraction of uniform light: Ē = A (1 + r (2/3 − 28/(15 π))). The rest has been scattered more than once:
//     f_ms = ρ′/π (1 − E(o)) (1 − E(i))/(1 − Ē),   ρ′ = ρ² Ē/(1 − ρ (1 − Ē))
// so that a white surface reflects all light, and a coloured one is the more saturated the rougher it is.
//
// References: Oren & Nayar, Generalization of Lambert's Reflectance Model, SIGGRAPH 1994; Portsmouth, Kutz & Hill, EON:
// A Practical Energy-Preserving Rough Diffuse BRDF, JCGT 14(1), 2025.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>

#include "phasetree/math/portable.hpp"
#include "sampling/warps.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class RoughDiffuseBsdf {
  public:
    /// `roughness` is r, in [0, 1].
    RoughDiffuseBsdf(const glm::vec3& albedo, float roughness)
        : albedo_(albedo), roughness_(roughness), a_(single_scattering(roughness)) {
        const float average = a_ * (1.0f + roughness * (2.0f / 3.0f - 28.0f / (15.0f * pi)));
        multiple_ = albedo * albedo * average / ((1.0f - albedo * (1.0f - average)) * std::max(1.0f - average, 1e-7f));
    }

    std::optional<BsdfSample> sample(const glm::vec3& wo, float /*u_lobe*/, const glm::vec2& u) const {
        const glm::vec3 wi = square_to_cosine_hemisphere(u);
        if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return std::nullopt;
        return BsdfSample{wi, over_lambert(wo, wi), cosine_hemisphere_pdf(wi.z), false, false};
    }
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
        if (!(wo.z > 0.0f) || !(wi.z > 0.0f)) return glm::vec3(0.0f);
        return over_lambert(wo, wi) * cosine_hemisphere_pdf(wi.z);
    }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& wi) const { return cosine_hemisphere_pdf(wi.z); }
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

    /// A for the roughness r.
    static float single_scattering(float r) { return 1.0f / (1.0f + (0.5f - 2.0f / (3.0f * pi)) * r); }
    /// G for the cosine c: the integral of (s/t) cos θ over the hemisphere. tan θ (1 − sin³θ) is written such that it
    /// is precise at grazing angles.
    static float oren_nayar_integral(float c) {
        const float cosine = std::min(c, 1.0f), sine = std::sqrt((1.0f - cosine) * (1.0f + cosine));
        return sine * (portable::acos(cosine) - sine * cosine) +
               2.0f / 3.0f * (sine * cosine * (1.0f + sine + sine * sine) / (1.0f + sine) - sine);
    }

  private:
    static constexpr float pi = std::numbers::pi_v<float>;

    /// Returns π f.
    glm::vec3 over_lambert(const glm::vec3& wo, const glm::vec3& wi) const {
        const float s = glm::dot(wo, wi) - wo.z * wi.z;
        const float t = s > 0.0f ? std::max(wo.z, wi.z) : 1.0f;
        return albedo_ * (a_ * (1.0f + roughness_ * s / t)) +
               multiple_ * ((1.0f - white_albedo_once(wo.z)) * (1.0f - white_albedo_once(wi.z)));
    }
    /// Returns E for the cosine c.
    float white_albedo_once(float c) const { return a_ * (1.0f + roughness_ * oren_nayar_integral(c) / pi); }

    glm::vec3 albedo_;
    float roughness_;
    float a_;             ///< A
    glm::vec3 multiple_;  ///< ρ′/(1 − Ē)
};

}  // namespace phasetree::tracer
