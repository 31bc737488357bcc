// What a medium shines where its temperature T is another at each place: with the density ρ, by Kirchhoff's and
// Planck's laws,
//     j(λ, p) = ρ(p) ε B(λ, T(p))/B(λ, T̄),
// where ε is what it shines at the wavelength λ where ρ is 1 and T the greatest temperature T̄.
//
// For red, green and blue the colour and brightness of that light are computed beforehand, for temperatures from 0 to
// T̄.
#pragma once

#include <memory>
#include <vector>

#include "media/voxel_density.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

class Heat {
  public:
    /// Temperatures as shares of the greatest one, which is given in kelvin.
    Heat(const VoxelDensity& shares, float hottest);

    /// T/T̄ at eight points.
    BatchOfFloats shares_at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const {
        return shares_.at(x, y, z);
    }
    /// The light at T/T̄ as a path takes it, of what shines `hottest_light` at T̄, with that luminance.
    glm::vec3 light(float share, const glm::vec3& hottest_light, float hottest_luminance,
                    const Wavelengths* wavelengths) const;
    /// The luminance at T/T̄ over that at T̄.
    float luminance(float share) const;

  private:
    glm::vec3 colour(float share) const;

    VoxelDensity shares_;
    float hottest_;
    std::shared_ptr<const std::vector<glm::vec3>> colours_;  ///< of even steps; of luminance 1 at T̄
};

}  // namespace phasetree::tracer
