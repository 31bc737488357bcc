// The coefficients of a scattering medium, per unit length of the scene and for each of the three components of light
// (spectrum/wavelengths.hpp).
#pragma once

#include <glm/vec3.hpp>

#include "media/absorption.hpp"
#include "media/phase_function.hpp"
#include "spectrum/light_spectrum.hpp"

namespace phasetree::tracer {

struct ScatteringCoefficients {
    Absorption absorption{};     ///< σa
    glm::vec3 scattering{0.0f};  ///< σs
    /// Emitted radiance per unit length.
    glm::vec3 emission{0.0f};
    SharedLightSpectrum emission_spectrum{};  ///< spectrum of the emission, if known
    PhaseFunction phase_function{};

    glm::vec3 extinction() const { return absorption.rgb() + scattering; }  ///< σt of red, green and blue
    /// An upper bound on σt over all wavelengths.
    float greatest_extinction() const { return absorption.greatest_with(scattering); }
    bool scatters() const { return scattering != glm::vec3(0.0f); }
    /// The coefficients of a medium with `factor` times the density.
    ScatteringCoefficients times(float factor) const {
        ScatteringCoefficients scaled = *this;
        scaled.absorption = absorption.times(factor);
        scaled.scattering *= factor;
        scaled.emission *= factor;
        return scaled;
    }

    /// All coefficients, for the light of one path.
    struct ForLight {
        glm::vec3 absorption, scattering, emission;
        glm::vec3 extinction() const { return absorption + scattering; }  ///< σt
        bool scatters() const { return scattering != glm::vec3(0.0f); }
    };
    /// At the wavelengths, or for red, green and blue.
    ForLight for_light(const Wavelengths* wavelengths) const {
        return {absorption.for_light(wavelengths), tracer::for_light(scattering, wavelengths),
                light_of(emission, emission_spectrum, wavelengths)};
    }
};

}  // namespace phasetree::tracer
