#pragma once

#include "phasetree/math/number.hpp"

namespace phasetree {

/// The angle in radians from the x axis to the direction (x, y), in [−π, π]; 0 for the zero vector. The error is at
/// most 3 ulp of π. Computed here because library functions differ between scalar and SIMD code. The polynomial
/// interpolates atan(√z)/√z, z = (y/x)², at the Chebyshev nodes of [0, 1]; its error is 5·10⁻⁹, that of its derivative
/// 7·10⁻⁸.
template <class T>
T angle_of(const T& x, const T& y) {
    constexpr float pi = 3.14159265358979f;
    const T width = abs(x), height = abs(y);
    const T t = min(width, height) / max(max(width, height), T(1e-30f));
    const T z = t * t;
    T s = z * 0.001057607471011579f - 0.0070306695997715f;
    s = z * s + 0.021912945434451103f;
    s = z * s - 0.04392841085791588f;
    s = z * s + 0.06685281544923782f;
    s = z * s - 0.08785043656826019f;
    s = z * s + 0.11050771176815033f;
    s = z * s - 0.14278575778007507f;
    s = z * s + 0.19999557733535767f;
    s = z * s - 0.33333322405815125f;
    const T slope = t + t * (z * s);
    const T first = select(less(width, height), pi * 0.5f - slope, slope);
    const T upper = select(less(x, T(0.f)), pi - first, first);
    return select(less(y, T(0.f)), -upper, upper);
}

}  // namespace phasetree
