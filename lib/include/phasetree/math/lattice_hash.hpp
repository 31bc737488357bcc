// Pseudo-random numbers for points of the integer lattice, from whole numbers modulo 289 = 17². x ↦ (34x + 5)x
// permutes them (a polynomial does modulo a square of a prime p if it does modulo p and its derivative does not vanish
// modulo p; here it is 5x modulo 17). Numbers on the way are kept between −144 and 144, so that the sum of two, and
// a few more, needs no reduction before it is hashed. All intermediate results are whole and below 2²², and what is
// rounded down is farther from a whole number than its rounding, so floats compute it exactly, whatever the
// instruction set. The idea of hashing in this way is that of McEwan et al., "Efficient Computational Noise in GLSL",
// 2012.
#pragma once

#include "phasetree/math/number.hpp"

namespace phasetree {

namespace lattice {

/// n modulo 289, from −144 to 144, for whole |n| < 2²².
template <class T>
T wrapped(const T& n) {
    return multiply_add(floor(multiply_add(n, 1.f / 289.f, T(0.5f))), -289.f, n);
}
/// The permutation of the residues, before it is reduced modulo 289.
template <class T>
T permuted(const T& n) {
    return multiply_add(n, 34.f, T(5.f)) * n;
}
/// The hash of n, from 0 to 288, for whole |n| ≤ 291.
template <class T>
T hashed(const T& n) {
    const T hash = permuted(n);
    return multiply_add(floor(multiply_add(hash, 1.f / 289.f, T(0.5f / 289.f))), -289.f, hash);
}
/// The hash of n, from −144 to 144, which may be added to another number and hashed again.
template <class T>
T hashed_on(const T& n) {
    return wrapped(permuted(n));
}

}  // namespace lattice

}  // namespace phasetree
