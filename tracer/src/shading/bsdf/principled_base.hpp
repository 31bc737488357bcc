// What is below the coat of a principled surface: a mix by metalness, as of small areas of both, of a metal and of a
// diffuse base with a gloss:
//
//   f = M f_metal + (1 − M) (f_gloss + f_diffuse)
//   f_gloss = F D G₂ / (4 |o.z| |i.z|)
//
// f_metal is rough_conductor.hpp, F is that of dielectric_layer.hpp, f_diffuse is diffuse_below.hpp. Gloss and metal
// have the same microfacets. Where they are smooth, both are specular reflections. The gloss loses no light to multiple
// scattering: what meets microfacets again reaches the diffuse base.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/diffuse_below.hpp"
#include "shading/bsdf/rough_conductor.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class PrincipledBase {
  public:
    struct Kind {
        float metalness = 0.0f;  ///< M
        float roughness = 0.0f;  ///< α of gloss and metal, across the grain if there is one; 0 is smooth
        glm::vec3 color{0.8f};   ///< of the diffuse base, seen through the gloss
        float diffuse_roughness = 0.0f;
        ConductorSurface::Place metal{};  ///< of the metal
    };
    /// The surface of the metal must outlive the base. It may be null if there is no metal.
    PrincipledBase(const Kind& kind, const DielectricLayer::At& gloss, const ConductorSurface* metal);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return is_metal() && is_smooth(); }
    bool passes_through() const { return false; }

    /// Whether it is metal only.
    bool is_metal() const { return !(metalness_ < 1.0f); }
    bool is_diffuse() const { return !is_metal(); }
    /// Roughly the directional albedo.
    glm::vec3 albedo(const glm::vec3& wo) const;
    /// From 0 for a mirror to 1 for a diffuse surface: the square root of α, where 1 replaces it for the light that
    /// enters the gloss at normal incidence.
    float apparent_roughness() const;

  private:
    /// The probabilities of the lobes; that of the metal is the rest.
    struct Choice {
        float gloss = 0.0f, diffuse = 0.0f;
        bool is_black = false;
    };
    Choice choice(const glm::vec3& wo) const;
    bool is_smooth() const { return !(roughness_ > 0.0f); }
    glm::vec3 metal_fresnel(float cosine) const { return surface_->fresnel(cosine, place_); }

    float metalness_, roughness_;
    DielectricLayer::At gloss_;
    DiffuseBelow diffuse_;
    const ConductorSurface* surface_;
    ConductorSurface::Place place_;
    std::optional<RoughConductorBsdf> metal_;  ///< where it is rough
};

}  // namespace phasetree::tracer
