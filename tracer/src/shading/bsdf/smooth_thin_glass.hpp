// A smooth pane without thickness: it reflects like a mirror and transmits straight on (shading/thin_pane.hpp).
//
// Both lobes are delta functions. Light that is transmitted keeps its direction, so shadow rays pass the pane without
// choosing at random.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/sample.hpp"
#include "shading/thin_pane.hpp"

namespace phasetree::tracer {

class SmoothThinGlassBsdf {
  public:
    explicit SmoothThinGlassBsdf(const ThinPane& pane) : pane_(pane) {}

    const ThinPane& pane() const { return pane_; }

    /// Chooses between the two lobes by their shares of the light.
    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& /*u*/) const {
        if (!(wo.z > 0.0f)) return std::nullopt;
        const ThinPane::Shares shares = pane_.at(wo.z);
        const float choice = shares.choice_of_reflection();
        if (u_lobe < choice) return BsdfSample{{-wo.x, -wo.y, wo.z}, shares.reflected / choice, choice, true, false};
        if (!(choice < 1.0f)) return std::nullopt;
        return BsdfSample{-wo, shares.transmitted / (1.0f - choice), 1.0f - choice, true, true};
    }
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return glm::vec3{0.0f}; }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& /*wi*/) const { return 0.0f; }
    bool is_delta() const { return true; }
    bool passes_through() const { return false; }

  private:
    ThinPane pane_;
};

}  // namespace phasetree::tracer
