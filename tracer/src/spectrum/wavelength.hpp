// A randomly chosen wavelength of light, and its contribution to red, green and blue.
//
// If the wavelength λ is chosen with the pdf p, and the light L(λ) is found there, a path contributes to each component
//     L(λ) w(λ)/p(λ),   ∫ w dλ = 1,
// where w is the weight of a wavelength for red, green or blue: the CIE colour matching functions, converted to
// Rec.709, times its white, the CIE illuminant D65. So L is relative to D65.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// The wavelength of Fraunhofer's d line in nanometres, at which tables list indices.
inline constexpr float wavelength_of_d_line = 587.5618f;

struct Wavelength {
    float nanometres = wavelength_of_d_line;
    glm::vec3 primaries{1.0f / 3.0f};  ///< ρ of primaries.hpp at this wavelength
    glm::vec3 response{1.0f};          ///< w/p: the contribution of light at this wavelength to red, green and blue
};

/// The distribution of wavelengths: a pdf p that is constant in each nanometre.
class WavelengthDistribution {
  public:
    /// Proportional to the sum of |w| over red, green and blue.
    WavelengthDistribution();
    /// Proportional to that sum times light(λ), the strength of a scene's light relative to D65. It must be positive
    /// from 380 to 780 nm.
    explicit WavelengthDistribution(const std::function<double(double)>& light);

    /// The wavelength chosen by u in [0, 1).
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

/// The wavelength chosen by u if nothing is known of the light.
Wavelength sampled_wavelength(float u);

/// ∫ w f dλ: the colour of D65 times f, which is evaluated at the centre of each nanometre between 380 and 780.
glm::dvec3 colour_of(const std::function<double(double)>& f);
/// ∫ |w| f dλ/∫ |w| dλ, with the sum of |w| over red, green and blue: the mean of f if nothing is known of the light.
double mean_of(const std::function<double(double)>& f);

}  // namespace phasetree::tracer
