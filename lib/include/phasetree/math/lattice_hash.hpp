#pragma once

#include "phasetree/math/number.hpp"

namespace phasetree {

/// Pseudo-random numbers for points of the integer lattice, from whole numbers modulo 289 = 17². x ↦ (34x + 5)x
/// permutes them (a polynomial does modulo a square of a prime p if it does modulo p and its derivative does not vanish
/// modulo p; here it is 5x modulo 17). All intermediate results are whole and below 2²², and (x + ½)/289 is
/// farther from a whole number than its rounding, so floats compute it exactly, whatever the instruction set. The idea
/// of hashing in this way is that of McEwan et al., "Efficient Computational Noise in GLSL", 2012.
namespace lattice {

/// n modulo 289, for whole |n| < 2¹⁸.
template <class T>
T wrapped(const T& n) {
    return n - floor((n + 0.5f) * (1.f / 289.f)) * 289.f;
}
template <class T>
T hashed(const T& n) {
    return wrapped((n * 34.f + 5.f) * n);
}
/// a + b modulo 289 for two numbers below it.
template <class T>
T sum(const T& a, const T& b) {
    const T s = a + b;
    return select(less(T(288.5f), s), s - 289.f, s);
}

}  // namespace lattice

}  // namespace phasetree
