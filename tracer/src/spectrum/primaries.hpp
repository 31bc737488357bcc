// How a colour becomes a spectrum. What is given as red, green and blue is at the wavelength λ
//     red ρ_r(λ) + green ρ_g(λ) + blue ρ_b(λ)
// with three spectra ρ, one for each of Rec.709's primaries, that add up to 1, and whose own colours in D65 are exactly
// red, green and blue: white stays white, no colour reflects more than all light, and the mean over wavelengths of
// every colour is that colour.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// ρ of red, green and blue at a wavelength in nanometres.
glm::vec3 primaries_at(double wavelength);

}  // namespace phasetree::tracer
