// Mathematical functions that give the same bits on x86-64 and arm64 processors with fused multiply-adds, with rare
// exceptions (below). Use them instead of the standard library's.
//
// The last bit of some functions of glibc differs between x86-64 and arm64: tan, asin, acos, atan2, log1p and expm1 of
// floats, and exp2, cbrt, hypot and erfc of doubles. Here, floats are computed in double precision and rounded once.
// This hides the difference, except where the exact value is so close to the middle between two floats that the error
// in double precision matters: fewer than one call in 10⁸. cbrt and hypot consist of operations that IEEE 754 requires
// to be correctly rounded, and exp2 calls pow.
//
// The float and double versions of sin, cos, exp, log and pow are the same on x86-64 and arm64, so call the standard
// library's. Some functions of doubles below agree too; they are here because a call does not show the type of its
// argument. For all of these, glibc uses fused multiply-adds, on arm64 and on x86-64 processors that have them. Without
// them (Intel's processors before 2013, for example), the last bit of functions of doubles differs.
#pragma once

#include <cmath>

namespace phasetree::portable {

inline double tan(double x) {
    return std::tan(x);
}
inline float tan(float x) {
    return static_cast<float>(std::tan(static_cast<double>(x)));
}
inline double asin(double x) {
    return std::asin(x);
}
inline float asin(float x) {
    return static_cast<float>(std::asin(static_cast<double>(x)));
}
inline double acos(double x) {
    return std::acos(x);
}
inline float acos(float x) {
    return static_cast<float>(std::acos(static_cast<double>(x)));
}
inline double atan2(double y, double x) {
    return std::atan2(y, x);
}
inline float atan2(float y, float x) {
    return static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline double log1p(double x) {
    return std::log1p(x);
}
inline float log1p(float x) {
    return static_cast<float>(std::log1p(static_cast<double>(x)));
}
inline double expm1(double x) {
    return std::expm1(x);
}
inline float expm1(float x) {
    return static_cast<float>(std::expm1(static_cast<double>(x)));
}

inline double exp2(double x) {
    return std::pow(2.0, x);
}
inline float exp2(float x) {
    return static_cast<float>(std::pow(2.0, static_cast<double>(x)));
}

/// √(x² + y²) for magnitudes from 10⁻¹⁵⁰ to 10¹⁵⁰, which include all floats. Smaller ones count as 0, larger ones give
/// infinity.
inline double hypot(double x, double y) {
    return std::sqrt(x * x + y * y);
}
inline float hypot(float x, float y) {
    return static_cast<float>(hypot(static_cast<double>(x), static_cast<double>(y)));
}
/// √(x² + y² + z²). With three arguments, the C++ library uses only operations that are correctly rounded.
inline double hypot(double x, double y, double z) {
    return std::hypot(x, y, z);
}
inline float hypot(float x, float y, float z) {
    return std::hypot(x, y, z);
}

/// The cube root, with a relative error of at most 5·10⁻¹⁶.
inline double cbrt(double x) {
    if (x == 0 || !std::isfinite(x)) return x;
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(x), &exponent);
    const int third = (exponent + 1200) / 3 - 400;  // rounded down, also if negative
    const double a = std::ldexp(mantissa, exponent - 3 * third);
    // a is in [1/2, 4). The line is within 14 % of its root, and each of Halley's steps cubes the error.
    double root = 0.6 + 0.27 * a;
    for (int step = 0; step < 3; ++step) {
        const double cube = root * root * root;
        root *= (cube + 2 * a) / (2 * cube + a);
    }
    return std::copysign(std::ldexp(root, third), x);
}
inline float cbrt(float x) {
    return static_cast<float>(cbrt(static_cast<double>(x)));
}

}  // namespace phasetree::portable
