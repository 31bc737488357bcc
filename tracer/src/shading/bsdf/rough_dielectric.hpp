// A rough interface between two clear media: GGX microfacets that each reflect and refract (Walter et al. 2007).
//
// With η = η_to/η_from and m the normal of the microfacet:
//
//   reflection,   m ∥ wo + wi:    f = F D G₂ / (4 |o.z| |i.z|)
//   transmission, m ∥ wo + η wi:  f = (1 − F) D G₂ |o·m| |i·m| / (|o.z| |i.z| (o·m + η i·m)²)
//
// The transmitted f contains the factor (η_from/η_to)² of radiance: f(o, i) η_to² is reciprocal. Light scattered more
// than once between microfacets is lost, at most some per cent for great roughness.
//
// Reference: Walter, Marschner, Li & Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007,
// equations 16, 17, 20 and 21, with visible normals in place of (24).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class RoughDielectricBsdf {
  public:
    RoughDielectricBsdf(float ior_from, float ior_to, float roughness);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return passes_through(); }
    bool passes_through() const { return eta_ == 1.0f; }

  private:
    /// The microfacet normal that takes wo to wi, on the side of wo; nothing if no microfacet does.
    std::optional<glm::vec3> microfacet(const glm::vec3& wo, const glm::vec3& wi) const;

    Ggx ggx_;
    float eta_;
    float radiance_factor_;
};

}  // namespace phasetree::tracer
