// A perfectly smooth interface between two clear media: Fresnel reflection and Snell refraction.
//
// Reflection is chosen with probability F, so its weight is exactly 1, and that of refraction exactly the factor of
// radiance (η_from/η_to)². The factors of entering and leaving are rounded once each from the exact squares; their
// product is 1 within an ulp.
//
// Equal indices are no interface at all to light: the ray goes straight on, and the path need not count it as an event.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

/// (η_from/η_to)²
float radiance_factor(float ior_from, float ior_to);

class SmoothDielectricBsdf {
  public:
    SmoothDielectricBsdf(float ior_from, float ior_to);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return glm::vec3{0.0f}; }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return 0.0f; }
    bool is_delta() const { return true; }
    bool passes_through() const { return eta_ == 1.0f; }

  private:
    float eta_;
    float radiance_factor_;
};

}  // namespace phasetree::tracer
