// This says of which light the three numbers are that a path carries.
//
// Without `"spectral"` they are red, green and blue, and stand for what the whole spectrum brings, until the path is
// refracted by something that bends colours differently. There one wavelength is chosen for it, the hero, and from then
// on all that it meets is what it is at this wavelength. Before dispersion there is no need to choose any, so a picture
// without dispersion has no noise in its colours.
//
// With `"spectral"` they are those of three wavelengths, a third of the spectrum apart by the density with which
// wavelengths are chosen, and all that the path meets is what it is at each of the three. Where it is dispersed the
// hero, the first of them, goes on alone and counts three times. The path's radiance becomes a colour in the end:
//     Σ L(λᵢ) w(λᵢ)/(3 p(λᵢ))   over the three; wavelength.hpp has w and p.
// Because the three are spread over the spectrum, they have far less noise in their colours than one wavelength that
// counts three times.
//
// Reference: Wilkie, Nawaz, Droske, Weidlich & Hanika, Hero Wavelength Spectral Sampling, EGSR 2014, whose wavelengths
// all but one end at dispersion, as here. They weigh the wavelengths against each other; here all three have the same
// density, so there is no weight.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

struct Wavelengths {
    /// For a path of red, green and blue that is dispersed, or was.
    static Wavelengths of_dispersed_colours(const Wavelength& hero);
    /// For a path of three wavelengths; u in [0, 1) chooses them.
    static Wavelengths three(float u, const WavelengthDistribution& distribution);

    glm::vec3 nanometres;  ///< of the path's numbers, the hero's first
    /// ρ of red, green and blue at the wavelengths, a column for each.
    glm::mat3 primaries;
    /// From what a path finds in the end to red, green and blue.
    glm::mat3 to_rgb;
    /// The factor that makes of what the hero alone brings the numbers of a path that is not dispersed: of colours the
    /// hero's response, of three wavelengths (3, 0, 0). A path of three is multiplied by it where it is dispersed. A
    /// path of colours is not, because to_rgb has the response; but what a dispersed shadow ray or photon brings it is.
    glm::vec3 hero_to_all;
    /// Whether the path has three wavelengths from its beginning on.
    bool is_spectral;

    float hero() const { return nanometres.x; }
};

/// What is given as red, green and blue, as a path takes it: at each of its wavelengths, or as it is where the path's
/// numbers are red, green and blue, and there are no `wavelengths`.
inline glm::vec3 for_light(const glm::vec3& rgb, const Wavelengths* wavelengths) {
    return wavelengths ? rgb * wavelengths->primaries : rgb;
}

/// What a path finds in the end, of its wavelengths if it has any, as red, green and blue.
inline glm::vec3 colour_of_found(const glm::vec3& found, const Wavelengths* wavelengths) {
    return wavelengths ? wavelengths->to_rgb * found : found;
}

}  // namespace phasetree::tracer
