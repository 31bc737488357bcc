// A thin sheet that reflects and transmits diffusely, the same from both sides: f = ρ/π on the side of the light, and
// τ/π on the other. A channel with ρ + τ > 1 would create light, so both are divided by their sum there.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"
#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

class ThinDiffuseBsdf {
  public:
    ThinDiffuseBsdf(const glm::vec3& reflectance, const glm::vec3& transmittance)
        : reflectance_(reflectance), transmittance_(transmittance) {
        for (int i = 0; i < 3; ++i) {
            const float sum = std::max(reflectance_[i] + transmittance_[i], 1.0f);
            reflectance_[i] /= sum;
            transmittance_[i] /= sum;
        }
        const float reflected = mean_of_channels(reflectance_), transmitted = mean_of_channels(transmittance_);
        if (reflected + transmitted > 0.0f) choice_of_reflection_ = reflected / (reflected + transmitted);
    }

    std::optional<BsdfSample> sample(const glm::vec3& /*wo*/, float u_lobe, const glm::vec2& u) const {
        glm::vec3 wi = square_to_cosine_hemisphere(u);
        if (!(wi.z > 0.0f)) return std::nullopt;
        const bool is_transmitted = !(u_lobe < choice_of_reflection_);
        const float choice = choice_of(is_transmitted), pdf = choice * cosine_hemisphere_pdf(wi.z);
        if (is_transmitted) wi.z = -wi.z;
        return BsdfSample{wi, albedo(is_transmitted) / choice, pdf, false, is_transmitted};
    }
    glm::vec3 evaluate(const glm::vec3& /*wo*/, const glm::vec3& wi) const {
        return albedo(wi.z < 0.0f) * cosine_hemisphere_pdf(std::abs(wi.z));
    }
    float pdf(const glm::vec3& /*wo*/, const glm::vec3& wi) const {
        return choice_of(wi.z < 0.0f) * cosine_hemisphere_pdf(std::abs(wi.z));
    }
    float reverse_pdf(const glm::vec3& wo, const glm::vec3& wi) const {
        return choice_of(wi.z < 0.0f) * cosine_hemisphere_pdf(std::abs(wo.z));
    }
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    const glm::vec3& albedo(bool is_transmitted) const { return is_transmitted ? transmittance_ : reflectance_; }
    float choice_of(bool is_transmitted) const {
        return is_transmitted ? 1.0f - choice_of_reflection_ : choice_of_reflection_;
    }

    glm::vec3 reflectance_, transmittance_;
    float choice_of_reflection_ = 1.0f;
};

}  // namespace phasetree::tracer
