// What a medium shines where its temperature T is another at each place: with the density ρ, by Kirchhoff's and
// Planck's laws,
//     j(λ, p) = ρ(p) ε B(λ, T(p))/B(λ, T₀),
// where ε is what it shines at the wavelength λ where ρ is 1 and the temperature T₀, which whoever gives ε chooses.
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
    /// Temperatures as shares of the greatest one. That and T₀ are in kelvin; both are positive.
    Heat(const VoxelDensity& shares, float hottest, float reference);

    /// T over the greatest temperature at eight points.
    BatchOfFloats shares_at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const {
        return shares_.at(x, y, z);
    }
    /// The light at such a share as a path takes it, of what shines `light_at_reference` at T₀, with that luminance.
    glm::vec3 light(float share, const glm::vec3& light_at_reference, float luminance_at_reference,
                    const Wavelengths* wavelengths) const;
    /// The luminance at such a share over that at T₀.
    float luminance(float share) const;
    std::size_t bytes() const { return shares_.bytes(); }

  private:
    glm::vec3 colour(float share) const;

    VoxelDensity shares_;
    float hottest_, reference_;
    std::shared_ptr<const std::vector<glm::vec3>> colours_;  ///< of luminance 1 at T₀
};

}  // namespace phasetree::tracer
