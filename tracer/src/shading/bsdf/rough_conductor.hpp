// A rough metal: GGX microfacets, f = F D G₂ / (4 |o.z| |i.z|) with Fresnel's equations for the complex index η + ik
// relative to the clear medium it touches.
//
// References: Cook & Torrance, A Reflectance Model for Computer Graphics, 1982; Walter et al. 2007 (see ggx.hpp).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class RoughConductorBsdf {
  public:
    /// Index relative to the medium in front.
    RoughConductorBsdf(const glm::vec3& eta, const glm::vec3& k, float roughness) : eta_(eta), k_(k), ggx_(roughness) {}

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    glm::vec3 eta_;
    glm::vec3 k_;
    Ggx ggx_;
};

}  // namespace phasetree::tracer
