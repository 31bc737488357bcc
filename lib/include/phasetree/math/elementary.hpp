// More functions for formulas, in addition to those of number.hpp and for the same number types. They do the same
// IEEE operations in the same order for all types, because library functions differ between scalar and SIMD code.
// `Enclosure` has its own overloads, without discontinuities.
#pragma once

#include "phasetree/math/number.hpp"

namespace phasetree {

/// 2ᵏ for an integer k in [−116, 116], exact. Multiplies the powers of 2 of the binary digits of k + 128.
template <class T>
T power_of_two(const T& k) {
    T rest = k + 128.f, result(1.f);
    float factor = 2;
    for (int digit = 0; digit < 7; ++digit) {
        const T half = floor(rest * 0.5f);
        // The digit is 0 or 1. From 2³² on, the − 1 and the + 1 are lost to rounding, but the product is still exactly
        // the factor or 1.
        result = result * ((rest - half * 2.f) * (factor - 1.f) + 1.f);
        rest = half;
        factor *= factor;
    }
    // The last digit determines whether k is negative. The factor 2⁻¹²⁸ would be subnormal, so the result is multiplied
    // twice by its square root.
    const T share = rest * (1.f - 5.42101086e-20f) + 5.42101086e-20f;
    return result * share * share;
}

/// eˣ, to about 3 ulp. x is clamped to [−80, 80].
template <class T>
T exponential(const T& x) {
    const T a = clamp(x, T(-80.f), T(80.f));
    const T k = floor(a * 1.44269504088896341f + 0.5f);
    // ln 2 is split into two parts, the first with few bits, so that its product with k is exact. Then a Taylor
    // polynomial for |r| ≤ ln 2/2.
    const T r = (a - k * 0.693359375f) - k * -2.12194440054690583e-4f;
    const T tail = r * (1.f / 5040) + (1.f / 720);
    const T series = ((((r * tail + (1.f / 120)) * r + (1.f / 24)) * r + (1.f / 6)) * r + 0.5f) * r + 1.f;
    return (series * r + 1.f) * power_of_two(k);
}

/// Sine and cosine of x in radians, for |x| up to 10⁴.
template <class T>
T sine_of(const T& x) {
    return sine_cosine(x).sine;
}
template <class T>
T cosine_of(const T& x) {
    return sine_cosine(x).cosine;
}

}  // namespace phasetree
