// Fuzz: fibres that stand on a surface and brighten its rim, as on velvet, or dust. The sheen of Estevez and Kulla,
// with microfacets whose normals are mostly along the surface:
//
//   f = D G/(4 o.z i.z),   D(m) = (2 + 1/α)/(2π) (1 − m.z²)^(1/(2α)),   G = 1/(1 + Λ(o) + Λ(i))
//
// α is the square of the roughness, at least 0.07: their fit of Λ would reflect more light than there is if α were
// smaller. E(μ) is the directional albedo, tabulated. Light that is not reflected continues to what is below, so a
// layer below is scaled by 1 − w E(o), where w is the share of the surface that has fuzz. The colour tints the
// reflected light only.
//
// References: Estevez & Kulla, Production Friendly Microfacet Sheen BRDF, SIGGRAPH course 2017 (D, Λ, and the scaling
// by albedo).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "shading/bsdf/film_of_surface.hpp"
#include "shading/bsdf/lost_energy.hpp"

namespace phasetree::tracer {

class Fuzz {
  public:
    /// α of a roughness in [0, 1].
    static float alpha_of(float roughness);
    /// 1 − E of a range of α.
    static LossTables losses_of(const ValueRange& alpha);

    Fuzz(const LossTables& losses, float alpha) : losses_(losses.at(alpha)), alpha_(alpha) {}

    /// f |cos θi| of white fibres.
    float evaluate(const glm::vec3& wo, const glm::vec3& wi) const { return value(alpha_, wo, wi); }
    float reflected(float cos_theta) const { return 1.0f - losses_.at(cos_theta).x; }  ///< E

    /// Uniform over the hemisphere, so that the weights are bounded.
    static glm::vec3 sample(const glm::vec2& u);
    static float pdf();

  private:
    static float value(float alpha, const glm::vec3& wo, const glm::vec3& wi);

    LossTables::At losses_;
    float alpha_;
};

}  // namespace phasetree::tracer
