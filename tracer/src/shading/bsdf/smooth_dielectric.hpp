// A perfectly smooth interface between two clear media: Fresnel reflection and Snell refraction.
//
// Reflection is chosen with probability F, so its weight is exactly 1, and that of refraction is exactly the radiance
// factor (η_from/η_to)². The factors of entering and leaving are rounded once each from the exact squares; their
// product is 1 within an ulp. With a thin film, which reflects some colours more than others, F is the mean of the
// colours, and the weights are their quotients.
//
// Equal indices without a film are no interface for light: the ray goes straight on, and the path need not count it as
// an event.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/dielectric_surface.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class SmoothDielectricBsdf {
  public:
    SmoothDielectricBsdf(float ior_from, float ior_to);
    /// The surface is shared by all points of an interface and must outlive the BSDF. The thickness of its film is in
    /// nanometres, and within the surface's range.
    explicit SmoothDielectricBsdf(const DielectricSurface& surface, float thickness = 0.0f,
                                  const Wavelengths* wavelengths = nullptr);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return glm::vec3{0.0f}; }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return 0.0f; }
    bool is_delta() const { return true; }
    bool passes_through() const { return eta_ == 1.0f && film_ == nullptr; }

  private:
    float eta_;
    float radiance_factor_;
    const DielectricSurface* film_ = nullptr;  ///< the surface, if it has a film
    float thickness_ = 0.0f;
    const Wavelengths* wavelengths_ = nullptr;
};

}  // namespace phasetree::tracer
