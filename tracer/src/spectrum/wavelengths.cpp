#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

Wavelengths Wavelengths::of_dispersed_colours(const Wavelength& hero) {
    glm::mat3 diagonal(0.0f);
    for (int i = 0; i < 3; ++i) diagonal[i][i] = hero.response[i];
    return {glm::vec3(hero.nanometres), glm::mat3(hero.primaries, hero.primaries, hero.primaries), diagonal,
            hero.response, false};
}

Wavelengths Wavelengths::three(float u, const WavelengthDistribution& distribution) {
    Wavelengths all{glm::vec3(0.0f), glm::mat3(0.0f), glm::mat3(0.0f), glm::vec3(3.0f, 0.0f, 0.0f), true};
    for (int i = 0; i < 3; ++i) {
        // The wrapped value is less than 1, even after rounding.
        const float at = u + static_cast<float>(i) / 3.0f;
        const Wavelength one = distribution.sample(at < 1.0f ? at : at - 1.0f);
        all.nanometres[i] = one.nanometres;
        all.primaries[i] = one.primaries;
        all.to_rgb[i] = one.response / 3.0f;
    }
    return all;
}

}  // namespace phasetree::tracer
