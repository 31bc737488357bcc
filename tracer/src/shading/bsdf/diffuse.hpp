// Lambert's law: f = ρ/π. Sampled proportional to the cosine, so that the weight is ρ.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/warps.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class DiffuseBsdf {
  public:
    explicit DiffuseBsdf(const glm::vec3& albedo) : albedo_(albedo) {}

    std::optional<BsdfSample> sample(const glm::vec3& /*wo*/, float /*u_lobe*/, const glm::vec2& u) const {
        const glm::vec3 wi = square_to_cosine_hemisphere(u);
        if (!(wi.z > 0.0f)) return std::nullopt;
        return BsdfSample{wi, albedo_, cosine_hemisphere_pdf(wi.z), false, false};
    }
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& wi) const {
        return albedo_ * cosine_hemisphere_pdf(wi.z);
    }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& wi) const { return cosine_hemisphere_pdf(wi.z); }
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    glm::vec3 albedo_;
};

}  // namespace phasetree::tracer
