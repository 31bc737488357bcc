// How the power of a light is spread over the wavelengths: by measured points, or as what is hot shines, by Planck's
// law (planck.hpp) at a temperature in kelvin: a candle has 1,900, a light bulb 2,700, a halogen lamp 3,000.
//
// Only its shape counts. How bright the light is, is said as for any other, as a radiance in red, green and blue, of
// which the luminance is kept and the colour replaced. Light of all spectra is relative to D65 (wavelength.hpp), so a
// light of wavelengths has the luminance times
//     S(λ)/D65(λ), scaled so that its luminance is 1,
// and one of colours that spectrum's colour. What of that is negative, because red, green and blue cannot mix the
// colour, is 0.
//
// Temperatures: Wyszecki & Stiles, Color Science, 2nd ed., 1982, section 1.2.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "spectrum/spectrum.hpp"

namespace phasetree::tracer {

class LightSpectrum {
  public:
    /// `power` is per nanometre, in any unit, and above 0 somewhere in the visible; else visible() is false.
    explicit LightSpectrum(const Spectrum& power);
    static LightSpectrum of_temperature(float kelvin);

    bool visible() const { return visible_; }
    /// Of luminance 1.
    const glm::vec3& colour() const { return colour_; }
    /// S/D65 at a wavelength, of luminance 1.
    float relative_at(float nanometres) const { return relative_.at(nanometres); }
    /// What a light of this spectrum sends that has the luminance of the colour `rgb`: at a path's wavelengths, or in
    /// red, green and blue.
    glm::vec3 light(const glm::vec3& rgb, const Wavelengths* wavelengths) const;

  private:
    Spectrum relative_;  ///< S/D65, of luminance 1
    glm::vec3 colour_;
    bool visible_;
};

/// None for a light that has only a colour.
using SharedLightSpectrum = std::shared_ptr<const LightSpectrum>;

/// The light of a colour as a path takes it, of this spectrum if there is one.
inline glm::vec3 light_of(const glm::vec3& rgb, const SharedLightSpectrum& spectrum, const Wavelengths* wavelengths) {
    return spectrum ? spectrum->light(rgb, wavelengths) : for_light(rgb, wavelengths);
}

}  // namespace phasetree::tracer
