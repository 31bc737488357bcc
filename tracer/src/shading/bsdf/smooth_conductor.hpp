// A polished metal: specular reflection, weighted by the reflectance of conductor_surface.hpp: Fresnel's equations for
// the complex index relative to the adjacent clear medium, or those of a thin film on it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/conductor_surface.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class SmoothConductorBsdf {
  public:
    /// The surface is shared by all points of an interface and must outlive the BSDF; the thickness of its film is
    /// within the surface's range.
    explicit SmoothConductorBsdf(const ConductorSurface& surface, const ConductorSurface::Place& place = {})
        : surface_(&surface), place_(place) {}

    std::optional<BsdfSample> sample(const glm::vec3& wo, float /*u_lobe*/, const glm::vec2& /*u*/) const {
        if (!(wo.z > 0.0f)) return std::nullopt;
        return BsdfSample{{-wo.x, -wo.y, wo.z}, surface_->fresnel(wo.z, place_), 1.0f, true, false};
    }
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return glm::vec3{0.0f}; }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return 0.0f; }
    bool is_delta() const { return true; }
    bool passes_through() const { return false; }

  private:
    const ConductorSurface* surface_;
    ConductorSurface::Place place_;
};

}  // namespace phasetree::tracer
