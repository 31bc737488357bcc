// Rayleigh's phase function, of particles much smaller than the wavelength: molecules of air, the finest smoke. With
// the cosine μ,
//     p(μ) = 3 (1 + μ²)/(16π).
// It is sampled exactly: 1/2 − (3μ + μ³)/8 = u has the solution μ = c − 1/c with c³ = z + √(z² + 1), z = 2 − 4u.
//
// Light is unpolarised here, as everywhere in this program. The blue of the sky comes from the scattering coefficient,
// which depends on the wavelength; the phase function does not.
//
// References: Rayleigh, On the Light from the Sky, its Polarization and Colour, Philosophical Magazine 41, 1871;
// Frisvad, Importance Sampling the Rayleigh Phase Function, JOSA A 28(12), 2011.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "media/scattered_direction.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

class Rayleigh {
  public:
    float mean_cosine() const { return 0.0f; }
    float evaluate(float cosine) const { return 3.0f / (16.0f * pi) * (1.0f + cosine * cosine); }
    glm::vec3 sample(const glm::vec2& u) const {
        const double z = 2.0 - 4.0 * static_cast<double>(u.x);
        // Of c and 1/c, the larger is computed, without cancellation.
        const double c = portable::cbrt(std::abs(z) + std::sqrt(z * z + 1.0));
        const double cosine = std::copysign(c - 1.0 / c, z);
        return scattered_direction(static_cast<float>(1.0 - cosine), u.y);
    }
};

}  // namespace phasetree::tracer
