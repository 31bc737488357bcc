// The emission of a medium with varying temperature T. By Kirchhoff's and Planck's laws it emits
//     j(λ, p) = ρ(p) ε B(λ, T(p))/B(λ, T₀)
// per unit length. Here ρ is the density, and ε the emission at the wavelength λ where ρ is 1 and the temperature is
// T₀. The scene specifies T₀ and the luminance of ε; the spectrum of ε is that of T₀.
//
// For red, green and blue, the colour and brightness of that light are precomputed at equidistant temperatures from 0
// to the greatest one.
#pragma once

#include <memory>
#include <vector>

#include "media/voxel_density.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

class Heat {
  public:
    /// Temperatures are stored like densities, as fractions of the greatest one. `greatest` and `reference` (T₀) are in
    /// kelvin and positive.
    Heat(const VoxelDensity& shares, float greatest, float reference);

    /// The temperature at a point, as a fraction of the greatest one.
    float share_at(const glm::vec3& p) const { return shares_.at(p); }
    /// The light at this fraction of the greatest temperature, in the components of a path. `luminance_at_reference` is
    /// its luminance at T₀.
    glm::vec3 light(float share, float luminance_at_reference, const Wavelengths* wavelengths) const;
    /// The luminance at this fraction of the greatest temperature, divided by that at T₀.
    float luminance(float share) const;
    /// The spectrum of the light at T₀.
    const SharedLightSpectrum& spectrum() const { return spectrum_; }
    std::size_t bytes() const { return shares_.bytes(); }

  private:
    glm::vec3 colour(float share) const;

    VoxelDensity shares_;
    float greatest_, reference_;
    SharedLightSpectrum spectrum_;
    std::shared_ptr<const std::vector<glm::vec3>> colours_;  ///< with luminance 1 at T₀
};

}  // namespace phasetree::tracer
