// Converts spectra to colours: the CIE 1931 colour matching functions (2° observer), and the red, green and blue of
// Rec.709.
//
// Reference: ITU-R BT.709-6, item 1.4 (the primaries, from which the matrix follows).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "spectrum/daylight.hpp"

namespace phasetree::tracer {

/// x̄, ȳ, z̄ at a wavelength in nanometres, from 380 to 780.
glm::dvec3 colour_matching(double wavelength);

inline glm::dvec3 rec709_from_xyz(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

/// A wavelength, and its weights for red, green and blue.
struct SpectralWeight {
    double wavelength;
    glm::dvec3 weight;
};

/// Weights for which D65 is white: those of each colour add up to 1. Some are negative, because Rec.709's primaries do
/// not span all colours.
inline std::vector<SpectralWeight> spectral_weights() {
    constexpr double first = 380.0, last = 780.0, step = 2.0;
    std::vector<SpectralWeight> weights;
    glm::dvec3 sum(0.0);
    for (double wavelength = first; wavelength <= last; wavelength += step) {
        weights.push_back({wavelength, daylight_at(wavelength) * rec709_from_xyz(colour_matching(wavelength))});
        sum += weights.back().weight;
    }
    for (SpectralWeight& w : weights) w.weight /= sum;
    return weights;
}

}  // namespace phasetree::tracer
