// One wavelength of light, chosen at random, and how much it counts for red, green and blue.
//
// With the wavelength λ chosen by the density p, and the light L(λ) found there, a path brings to each of the three
//     L(λ) w(λ)/p(λ),   ∫ w dλ = 1,
// where w is how much a wavelength counts for red, green or blue: CIE's colour matching functions, as Rec.709 has them,
// times the white of its screens, CIE's illuminant D65. So L is relative to D65.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// The wavelength of Fraunhofer's line d in nanometres, for which tables give indices.
inline constexpr float wavelength_of_d_line = 587.5618f;

struct Wavelength {
    float nanometres = wavelength_of_d_line;
    glm::vec3 primaries{1.0f / 3.0f};  ///< ρ of primaries.hpp at this wavelength
    glm::vec3 response{1.0f};          ///< w/p: what light of this wavelength brings to red, green and blue
};

/// How wavelengths are chosen: p, the same within each nanometre.
class WavelengthDistribution {
  public:
    /// In proportion to the sum of |w| over red, green and blue.
    WavelengthDistribution();
    /// In proportion to that sum times light(λ), how strong the light of a scene is relative to D65. It must be more
    /// than 0 from 380 to 780 nm.
    explicit WavelengthDistribution(const std::function<double(double)>& light);

    /// The wavelength that u in [0, 1) chooses.
    Wavelength sample(float u) const;
    /// ∫ w f dλ.
    glm::dvec3 colour_of(const std::function<double(double)>& f) const;
    /// ∫ p f dλ.
    double mean_of(const std::function<double(double)>& f) const;

  private:
    static constexpr std::size_t cells = 400;

    std::array<double, cells> cumulative_;
    std::array<glm::vec3, cells> response_;
};

/// The wavelength that u chooses where nothing is known of the light.
Wavelength sampled_wavelength(float u);

/// ∫ w f dλ: the colour of D65 times f, which is asked in the middle of each nanometre between 380 and 780.
glm::dvec3 colour_of(const std::function<double(double)>& f);
/// ∫ |w| f dλ/∫ |w| dλ, with the sum of |w| over red, green and blue: the mean of f where nothing is known of the
/// light.
double mean_of(const std::function<double(double)>& f);

}  // namespace phasetree::tracer
