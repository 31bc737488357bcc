// Pseudo-random numbers for the points of the integer lattice.
//
// Numbers are integers modulo 289 = 17², and are permuted by x ↦ (34x + 5)x. (A polynomial permutes the residues modulo
// p² for a prime p if it permutes those modulo p and its derivative does not vanish modulo p. Modulo 17 this polynomial
// is 5x.) Intermediate numbers are kept between −144 and 144, so that the sum of two of them plus a small integer can
// be hashed without reduction.
//
// Floats compute all of this exactly, with any instruction set: all intermediate results are integers below 2²², and
// every argument of floor() is farther from an integer than its rounding error.
//
// The idea is from McEwan et al., "Efficient Computational Noise in GLSL", 2012.
#pragma once

#include "phasetree/math/number.hpp"

namespace phasetree {

namespace lattice {

/// n modulo 289, from −144 to 144, for an integer |n| < 2²².
template <class T>
T wrapped(const T& n) {
    return multiply_add(floor(multiply_add(n, 1.f / 289.f, T(0.5f))), -289.f, n);
}
/// The permutation of the residues, not reduced modulo 289.
template <class T>
T permuted(const T& n) {
    return multiply_add(n, 34.f, T(5.f)) * n;
}
/// The hash of n, from 0 to 288, for an integer |n| ≤ 291.
template <class T>
T hashed(const T& n) {
    const T hash = permuted(n);
    return multiply_add(floor(multiply_add(hash, 1.f / 289.f, T(0.5f / 289.f))), -289.f, hash);
}
/// The hash of n, from −144 to 144, to be added to another number and hashed again.
template <class T>
T hashed_on(const T& n) {
    return wrapped(permuted(n));
}

}  // namespace lattice

}  // namespace phasetree
