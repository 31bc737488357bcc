// A rough metal: GGX microfacets, f = F D G₂ / (4 |o.z| |i.z|), with Fresnel's equations for the complex index η + ik
// relative to the adjacent clear medium. Multiple scattering adds f = c (1 − E(o)) (1 − E(i)) / (π L̄), see
// lost_energy.hpp, with c from conductor_surface.hpp. If the metal has a grain, local x is along it.
//
// References: Cook & Torrance, A Reflectance Model for Computer Graphics, 1982; Walter et al. 2007 (see ggx.hpp).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/conductor_surface.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class RoughConductorBsdf {
  public:
    /// The surface is shared by all points of an interface and must outlive the BSDF. `roughness` and the thickness of
    /// the film are within the surface's ranges.
    RoughConductorBsdf(const ConductorSurface& surface, float roughness, const ConductorSurface::Place& place = {});

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    /// f |cos θi|, and the pdf with which it is sampled.
    struct Scattered {
        glm::vec3 value;
        float pdf;
    };
    /// At the microfacet with this normal, plus multiple scattering.
    Scattered scattered(const glm::vec3& wo, const glm::vec3& wi, const glm::vec3& m) const;

    const ConductorSurface* surface_;
    Ggx ggx_;
    ConductorSurface::Place place_;
    ConductorSurface::Multiple multiple_;
};

}  // namespace phasetree::tracer
