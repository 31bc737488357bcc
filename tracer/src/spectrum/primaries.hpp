// Converts colours to spectra. At the wavelength λ, a colour given as red, green and blue is
//     red ρ_r(λ) + green ρ_g(λ) + blue ρ_b(λ)
// with three spectra ρ, one for each of Rec.709's primaries. They add up to 1, and their own colours in D65 are exactly
// red, green and blue: white stays white, no colour reflects more than all light, and the mean over wavelengths of
// every colour is that colour.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// ρ of red, green and blue at a wavelength in nanometres.
glm::vec3 primaries_at(double wavelength);

}  // namespace phasetree::tracer
