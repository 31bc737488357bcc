// A diffuse base below a dielectric layer (dielectric_layer.hpp), without the layer's own reflection. With f of
// rough_diffuse.hpp for the roughness r, S(i) = T(i)/T̄, and the seen colour c:
//
//   f = T(o)/π (c S(i) A (1 + r s/t) + c′ (1 − B(o)) (1 − B(i)) S(i) / Z)
//   B(o) = A (1 + r H(o)/T̄)                         the albedo of the first term, for c = 1
//   Z = 1/π ∫ S(i) (1 − B(i)) cos θᵢ dω,   c′ = c² (1 − Z)/(1 − c Z)
//
// so that white reflects all that enters, in any direction: f has the albedo T(o). f is reciprocal if T is the same for
// both directions. For r = 0 it is f = c T(o) T(i)/(π T̄), the exact form for a smooth layer, as in coated_diffuse.hpp.
// There, c is the albedo of the bare base; here, it is the colour seen through the layer, as OpenPBR defines its base
// colour. Without a layer, f is rough_diffuse.hpp.
//
// References: Kelemen & Szirmay-Kalos 2001 (lost_energy.hpp); OpenPBR Surface 1.1, "Glossy-diffuse".
#pragma once

#include <glm/vec3.hpp>

#include "shading/bsdf/dielectric_layer.hpp"

namespace phasetree::tracer {

class DiffuseBelow {
  public:
    /// The layer must have been made with a rough base unless the roughness is 0.
    DiffuseBelow(const DielectricLayer::At& layer, const glm::vec3& color, float roughness);

    /// f |cos θi|, sampled by Lambert's law. Both directions have z > 0.
    glm::vec3 evaluate(const DielectricLayer::At& layer, const glm::vec3& wo, const glm::vec3& wi) const;
    const glm::vec3& color() const { return color_; }

  private:
    /// 1 − B.
    glm::vec3 lost(const glm::vec3& oren_nayar) const;

    glm::vec3 color_;
    float roughness_;
    float a_ = 1.0f;                ///< A
    glm::vec3 over_average_{1.0f};  ///< 1/T̄
    glm::vec3 multiple_{0.0f};      ///< c′/Z
};

}  // namespace phasetree::tracer
