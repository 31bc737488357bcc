// What a medium that scatters is made of, for each of the three numbers of light (spectrum/wavelengths.hpp) and per
// unit of length of the scene.
#pragma once

#include <glm/vec3.hpp>

#include "media/absorption.hpp"
#include "media/henyey_greenstein.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

struct ScatteringCoefficients {
    Absorption absorption{};     ///< σa
    glm::vec3 scattering{0.0f};  ///< σs
    /// What it shines by itself: radiance per unit of length.
    glm::vec3 emission{0.0f};
    SharedLightSpectrum emission_spectrum{};  ///< of that, if it is known
    HenyeyGreenstein phase_function{};

    glm::vec3 extinction() const { return absorption.rgb() + scattering; }  ///< σt of red, green and blue
    /// At least σt at any wavelength.
    float greatest_extinction() const { return absorption.greatest_with(scattering); }
    bool scatters() const { return scattering != glm::vec3(0.0f); }
    /// The same of what is so many times as dense.
    ScatteringCoefficients times(float factor) const {
        ScatteringCoefficients scaled = *this;
        scaled.absorption = absorption.times(factor);
        scaled.scattering *= factor;
        scaled.emission *= factor;
        return scaled;
    }

    /// All of it for one path.
    struct ForLight {
        glm::vec3 absorption, scattering, emission;
        glm::vec3 extinction() const { return absorption + scattering; }  ///< σt
        bool scatters() const { return scattering != glm::vec3(0.0f); }
    };
    /// At the wavelengths of light, or for red, green and blue.
    ForLight for_light(const Wavelengths* wavelengths) const {
        return {absorption.for_light(wavelengths), tracer::for_light(scattering, wavelengths),
                light_of(emission, emission_spectrum, wavelengths)};
    }
};

}  // namespace phasetree::tracer
