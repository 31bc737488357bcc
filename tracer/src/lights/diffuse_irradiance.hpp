// Roughly how much light from infinitely far away a surface receives, by the direction that it faces:
//     E(n) ≈ Σ_lm A_l L_lm Y_lm(n),   A₀ = π, A₁ = 2π/3, A₂ = π/4,
// with the coefficients L_lm of the luminance in the first nine spherical harmonics. For light from all around it is
// right to a few hundredths; it serves the choice among lights, where it need only be near.
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

    /// Of a surface of this unit normal, as a luminance. It is greater than 0 unless the light is black.
    float at(const glm::vec3& normal) const;

    /// By how much to choose the light less where paths find it by themselves, too: the part of its luminance above its
    /// mean, ∫ max(L − L̄, 0) / ∫ L, and a tenth at least. The directions that BSDFs sample find an even sky as well as
    /// shadow rays do, which are better spent on lamps. A small sun in a sky keeps nearly all. This is the idea of MIS
    /// compensation, but for the choice of a light alone: the density within the light stays.
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
