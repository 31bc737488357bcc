// The power heuristic with exponent 2 (Veach & Guibas: Optimally Combining Sampling Techniques for Monte Carlo
// Rendering, SIGGRAPH 1995): the weight of a sample of density a, which other techniques would have found with
// densities b and c.
#pragma once

namespace phasetree::tracer {

inline float power_heuristic(float a, float b, float c = 0.0f) {
    // The square of the quotient does not overflow where a² could.
    const float p = b / a, q = c / a;
    return 1.0f / (1.0f + p * p + q * q);
}

}  // namespace phasetree::tracer
