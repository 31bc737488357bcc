// The power heuristic with exponent 2 (Veach & Guibas: Optimally Combining Sampling Techniques for Monte Carlo
// Rendering, SIGGRAPH 1995): the weight of a sample with pdf a that other techniques would have found with pdfs b and
// c.
#pragma once

namespace phasetree::tracer {

inline float power_heuristic(float a, float b, float c = 0.0f) {
    // The squared quotient does not overflow where a² could.
    const float p = b / a, q = c / a;
    return 1.0f / (1.0f + p * p + q * q);
}

}  // namespace phasetree::tracer
