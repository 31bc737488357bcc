// A rough interface between two clear media: GGX microfacets that each reflect and refract (Walter et al. 2007).
//
// With η = η_to/η_from and m the normal of the microfacet:
//
//   reflection,   m ∥ wo + wi:    f = F D G₂ / (4 |o.z| |i.z|)
//   transmission, m ∥ wo + η wi:  f = (1 − F) D G₂ |o·m| |i·m| / (|o.z| |i.z| (o·m + η i·m)²)
//
// plus multiple scattering (lost_energy.hpp), with a the side of wo, b the side behind, and t of
// dielectric_surface.hpp:
//
//   reflection:    f = (1 − t) (1 − E_a(o)) (1 − E_a(i)) / (π L̄_a)
//   transmission:  f = t (1 − E_a(o)) (1 − E_b(i)) / (π L̄_b)
//
// The transmitted f of both contains the factor (η_from/η_to)² of radiance: f(o, i) η_to² is reciprocal.
//
// Reference: Walter, Marschner, Li & Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007,
// equations 16, 17, 20 and 21, with visible normals instead of (24).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/dielectric_surface.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class RoughDielectricBsdf {
  public:
    /// The surface is shared by all points of an interface and must outlive the BSDF; `roughness` is within its range.
    /// The reflectance for spectral light is derived from that for red, green and blue, so that single and multiple
    /// scattering together conserve energy. This makes a difference only with a film.
    RoughDielectricBsdf(const DielectricSurface& surface, float roughness, const Wavelengths* wavelengths = nullptr);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    /// See Bsdf::reverse_pdf().
    float reverse_pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    /// f |cos θi|, and the pdf with which it is sampled.
    struct Scattered {
        glm::vec3 value{0.0f};
        float pdf = 0.0f;
    };

    /// The microfacet normal that scatters wo to wi, on the side of wo; nullopt if no microfacet does.
    std::optional<glm::vec3> microfacet(const glm::vec3& wo, const glm::vec3& wi) const;
    /// Single scattering at a microfacet with this normal.
    Scattered once(const glm::vec3& wo, const glm::vec3& wi, const glm::vec3& m) const;
    /// Single scattering (none, without a microfacet) plus multiple scattering.
    Scattered scattered(const glm::vec3& wo, const glm::vec3& wi, const std::optional<glm::vec3>& m) const;

    const DielectricSurface* surface_;
    const Wavelengths* wavelengths_;  ///< null where there is no film
    Ggx ggx_;
    float eta_;
    DielectricSurface::Multiple multiple_;
    float transmitted_;       ///< probability of transmission in multiple scattering
    float transmitted_back_;  ///< the same for light from the other side
};

}  // namespace phasetree::tracer
