// This is the light of a medium whose temperature T varies. By Kirchhoff's and Planck's laws it emits
//     j(λ, p) = ρ(p) ε B(λ, T(p))/B(λ, T₀)
// per unit of length, where ρ is the density, and ε what the medium emits at the wavelength λ where ρ is 1 and the
// temperature is T₀. The scene chooses T₀, and gives the luminance of ε; its spectrum is that of T₀.
//
// For red, green and blue the colour and brightness of that light are computed beforehand, for even steps of the
// temperature from 0 to the greatest one.
#pragma once

#include <memory>
#include <vector>

#include "media/voxel_density.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

class Heat {
  public:
    /// Temperatures are kept as densities are, as shares of the greatest one. That and T₀ are in kelvin, and positive.
    Heat(const VoxelDensity& shares, float greatest, float reference);

    /// The temperature at a point, as a share of the greatest one.
    float share_at(const glm::vec3& p) const { return shares_.at(p); }
    /// The light at such a share, as a path takes it, of what emits light of that luminance at T₀.
    glm::vec3 light(float share, float luminance_at_reference, const Wavelengths* wavelengths) const;
    /// The luminance at such a share over that at T₀.
    float luminance(float share) const;
    /// The spectrum of the light at T₀.
    const SharedLightSpectrum& spectrum() const { return spectrum_; }
    std::size_t bytes() const { return shares_.bytes(); }

  private:
    glm::vec3 colour(float share) const;

    VoxelDensity shares_;
    float greatest_, reference_;
    SharedLightSpectrum spectrum_;
    std::shared_ptr<const std::vector<glm::vec3>> colours_;  ///< of luminance 1 at T₀
};

}  // namespace phasetree::tracer
