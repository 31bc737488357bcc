// Planck's law: the emission of a black body at a wavelength λ is proportional to
//     B(λ, T) ∝ λ⁻⁵/(exp(c₂/(λ T)) − 1),   c₂ = 1.4388·10⁷ nm K,
// at the temperature T in kelvin. Reference: CODATA 2018 (c₂).
#pragma once

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

/// c₂/(λ T).
inline double planck_exponent(double nanometres, double kelvin) {
    constexpr double second_radiation_constant = 1.438776877e7;  // nm K
    return second_radiation_constant / (nanometres * kelvin);
}

/// B(λ, T) over B(λ, reference), with temperatures in kelvin; 0 for 0 K.
inline double planck_ratio(double nanometres, double kelvin, double reference) {
    if (!(kelvin > 0)) return 0;
    return portable::expm1(planck_exponent(nanometres, reference)) /
           portable::expm1(planck_exponent(nanometres, kelvin));
}

}  // namespace phasetree::tracer
