// The spectral distribution of a light: measured points, or a black body by Planck's law (planck.hpp) at a temperature
// in kelvin: a candle has 1,900, a light bulb 2,700, a halogen lamp 3,000.
//
// Only the shape of the spectrum is used. The brightness of the light is specified as for any other light, by a
// radiance in red, green and blue: its luminance is kept and its colour replaced. Spectral light is relative to D65
// (wavelength.hpp), so for a spectral path the light is the luminance times
//     S(λ)/D65(λ), scaled to the luminance 1,
// and for other paths it has the colour of that spectrum. Components that are negative, because red, green and blue
// cannot mix the colour, are set to 0.
//
// Temperatures: Wyszecki & Stiles, Color Science, 2nd ed., 1982, section 1.2.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "spectrum/spectrum.hpp"

namespace phasetree::tracer {

class LightSpectrum {
  public:
    /// `power` is per nanometre, in any unit. If it is 0 in the whole visible range, visible() is false.
    explicit LightSpectrum(const Spectrum& power);
    static LightSpectrum of_temperature(float kelvin);

    bool visible() const { return visible_; }
    /// With luminance 1.
    const glm::vec3& colour() const { return colour_; }
    /// S/D65 at a wavelength, with luminance 1.
    float relative_at(float nanometres) const { return relative_.at(nanometres); }
    /// The emission with this spectrum and the luminance of the colour `rgb`, at a path's wavelengths, or in red, green
    /// and blue.
    glm::vec3 light(const glm::vec3& rgb, const Wavelengths* wavelengths) const;

  private:
    Spectrum relative_;  ///< S/D65, with luminance 1
    glm::vec3 colour_;
    bool visible_;
};

/// Null for a light that has only a colour.
using SharedLightSpectrum = std::shared_ptr<const LightSpectrum>;

/// The light of a colour in the components of a path, with the given spectrum unless that is null.
inline glm::vec3 light_of(const glm::vec3& rgb, const SharedLightSpectrum& spectrum, const Wavelengths* wavelengths) {
    return spectrum ? spectrum->light(rgb, wavelengths) : for_light(rgb, wavelengths);
}

}  // namespace phasetree::tracer
