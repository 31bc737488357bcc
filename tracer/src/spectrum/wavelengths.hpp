// The meaning of the three components of the light that a path carries.
//
// Without `"spectral"`, they are red, green and blue, and represent the contribution of the whole spectrum until the
// path is refracted by a dispersive interface. There, one wavelength is chosen for the path, the hero, and from then on
// everything is evaluated at this wavelength. No wavelength is needed before dispersion, so a picture without
// dispersion has no noise in its colours.
//
// With `"spectral"`, they are those of three wavelengths, a third of the spectrum apart in terms of the pdf of
// wavelengths, and everything is evaluated at each of the three. On dispersion, the hero, which is the first of them,
// continues alone and counts three times. The path's radiance is finally converted to a colour:
//     Σ L(λᵢ) w(λᵢ)/(3 p(λᵢ))   over the three; wavelength.hpp has w and p.
// Because the three are spread over the spectrum, they have far less colour noise than one wavelength that counts three
// times.
//
// Reference: Wilkie, Nawaz, Droske, Weidlich & Hanika, Hero Wavelength Spectral Sampling, EGSR 2014. There, too, all
// wavelengths except one end at dispersion. Their MIS weights among wavelengths are unnecessary here because all three
// have the same pdf.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

struct Wavelengths {
    /// For a path of red, green and blue that is or was dispersed.
    static Wavelengths of_dispersed_colours(const Wavelength& hero);
    /// For a path of three wavelengths, chosen by u in [0, 1).
    static Wavelengths three(float u, const WavelengthDistribution& distribution);

    glm::vec3 nanometres;  ///< of the path's components, the hero's first
    /// ρ of red, green and blue at the wavelengths, a column for each.
    glm::mat3 primaries;
    /// Converts the light that a path finds to red, green and blue.
    glm::mat3 to_rgb;
    /// The factor that converts a contribution of the hero alone to the components of an undispersed path: for colours
    /// the hero's response, for three wavelengths (3, 0, 0). A path of three wavelengths is multiplied by it on
    /// dispersion. A path of colours is not, because to_rgb includes the response, but contributions of a dispersed
    /// shadow ray or photon to it are.
    glm::vec3 hero_to_all;
    /// Whether the path has three wavelengths from its start.
    bool is_spectral;

    float hero() const { return nanometres.x; }
};

/// Converts red, green and blue to the components of a path: the values at its wavelengths, or unchanged if
/// `wavelengths` is null because the path's components are red, green and blue.
inline glm::vec3 for_light(const glm::vec3& rgb, const Wavelengths* wavelengths) {
    return wavelengths ? rgb * wavelengths->primaries : rgb;
}

/// Converts the light that a path found, in its wavelengths if any, to red, green and blue.
inline glm::vec3 colour_of_found(const glm::vec3& found, const Wavelengths* wavelengths) {
    return wavelengths ? wavelengths->to_rgb * found : found;
}

}  // namespace phasetree::tracer
