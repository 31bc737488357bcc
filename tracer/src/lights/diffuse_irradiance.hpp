// Approximates the irradiance from infinite lights by the normal n of a surface:
//     E(n) ≈ Σ_lm A_l L_lm Y_lm(n),   A₀ = π, A₁ = 2π/3, A₂ = π/4,
// with the coefficients L_lm of the luminance in the first nine spherical harmonics. For light from all around, the
// error is a few hundredths. That is sufficient for the choice among lights.
//
// Reference: Ramamoorthi & Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "lights/kinds.hpp"

namespace phasetree::tracer {

class DiffuseIrradiance {
  public:
    explicit DiffuseIrradiance(const InfiniteLight& light);

    /// At a surface with this unit normal, as a luminance. It is positive unless the light is black.
    float at(const glm::vec3& normal) const;

    /// A factor on the probability of choosing the light where paths find it by sampling BSDFs, too: the part of its
    /// luminance above its mean, ∫ max(L − L̄, 0) / ∫ L, and at least a tenth. Directions sampled from BSDFs find an
    /// even sky as well as shadow rays do, and shadow rays are better spent on lamps. For a small sun in a sky the
    /// factor is nearly 1. This is the idea of MIS compensation, but applied only to the choice of a light; the pdf
    /// within the light is unchanged.
    ///
    /// Reference: Karlík et al., MIS Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling,
    /// SIGGRAPH Asia 2019.
    float unevenness() const { return unevenness_; }

  private:
    std::array<float, 9> coefficients_{};
    float least_ = 0;
    float unevenness_ = 1;
};

}  // namespace phasetree::tracer
