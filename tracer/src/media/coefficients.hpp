// What a medium that scatters is made of, in each colour channel and per unit of length of the scene.
#pragma once

#include <glm/vec3.hpp>

#include "media/henyey_greenstein.hpp"
#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

struct ScatteringCoefficients {
    glm::vec3 absorption{0.0f};  ///< σa
    glm::vec3 scattering{0.0f};  ///< σs
    /// What it shines by itself: radiance per unit of length. It is 0 in channels that are neither absorbed nor
    /// scattered, where it would have no bound.
    glm::vec3 emission{0.0f};
    HenyeyGreenstein phase_function{};

    /// The same of one wavelength, or as they are for light of all.
    ScatteringCoefficients for_light(const Wavelength* single) const {
        return {tracer::for_light(absorption, single), tracer::for_light(scattering, single),
                tracer::for_light(emission, single), phase_function};
    }
    glm::vec3 extinction() const { return absorption + scattering; }  ///< σt
    bool scatters() const { return scattering != glm::vec3(0.0f); }
};

}  // namespace phasetree::tracer
