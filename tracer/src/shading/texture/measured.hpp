// A measured colour: the reflectance at each wavelength. Paths in red, green and blue use its colour in daylight, D65.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"
#include "spectrum/spectrum.hpp"

namespace phasetree::tracer {

/// A list of points, [[wavelength, value], …], with increasing wavelengths.
struct SpectrumParameter : Parameter {};

struct MeasuredTexture {
    static constexpr KindInfo info{"measured", "A colour given by a measured reflectance spectrum."};

    SharedSpectrum reflectance{};

    template <class V>
    static void parameters(V&& v) {
        v(&MeasuredTexture::reflectance,
          SpectrumParameter{{"reflectance", "nm", "Wavelengths and the reflectance at each.", limits::fraction}});
    }

    glm::vec3 at(const glm::vec3& /*position*/) const { return glm::clamp(reflectance->colour(), 0.0f, 1.0f); }
    glm::vec3 at(const glm::vec3& position, const Wavelengths& wavelengths) const {
        return wavelengths.is_spectral ? reflectance->at(wavelengths) : for_light(at(position), &wavelengths);
    }
};

}  // namespace phasetree::tracer
