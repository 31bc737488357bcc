// A polished metal: mirror reflection, weighted by Fresnel's equations for the complex index η + ik relative to the
// clear medium it touches.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/sample.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer {

class SmoothConductorBsdf {
  public:
    /// Relative to the medium in front.
    SmoothConductorBsdf(const glm::vec3& eta, const glm::vec3& k) : eta_(eta), k_(k) {}

    std::optional<BsdfSample> sample(const glm::vec3& wo, float /*u_lobe*/, const glm::vec2& /*u*/) const {
        if (!(wo.z > 0.0f)) return std::nullopt;
        return BsdfSample{{-wo.x, -wo.y, wo.z}, fresnel_conductor(wo.z, eta_, k_), 1.0f, true, false};
    }
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return glm::vec3{0.0f}; }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return 0.0f; }
    bool is_delta() const { return true; }
    bool passes_through() const { return false; }

  private:
    glm::vec3 eta_;
    glm::vec3 k_;
};

}  // namespace phasetree::tracer
