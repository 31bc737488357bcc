// Complex numbers whose operations give the same bits on every processor. Quotients and square roots of
// std::complex<double> are functions of the compiler's library and the C library, which differ in the last bits between
// x86-64 and arm64. Magnitudes must be 0 or from 10⁻¹⁵⁰ to 10¹⁵⁰, so that their squares neither overflow nor underflow.
#pragma once

#include <cmath>

namespace phasetree::tracer {

struct Complex {
    double real = 0.0, imaginary = 0.0;

    friend Complex operator+(const Complex& a, const Complex& b) {
        return {a.real + b.real, a.imaginary + b.imaginary};
    }
    friend Complex operator-(const Complex& a, const Complex& b) {
        return {a.real - b.real, a.imaginary - b.imaginary};
    }
    friend Complex operator*(const Complex& a, const Complex& b) {
        return {a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real};
    }
    friend Complex operator/(const Complex& a, const Complex& b) {
        const double square = squared_magnitude(b);
        return {(a.real * b.real + a.imaginary * b.imaginary) / square,
                (a.imaginary * b.real - a.real * b.imaginary) / square};
    }
    friend double squared_magnitude(const Complex& z) { return z.real * z.real + z.imaginary * z.imaginary; }

    /// The root with a real part of at least 0. Roots of real numbers are exactly real or exactly imaginary.
    friend Complex sqrt(const Complex& z) {
        const double half = std::sqrt(0.5 * (std::sqrt(squared_magnitude(z)) + std::abs(z.real)));
        if (half == 0.0) return {};
        const double other = 0.5 * z.imaginary / half;
        return z.real < 0.0 ? Complex{std::abs(other), std::copysign(half, z.imaginary)} : Complex{half, other};
    }
    friend Complex exp(const Complex& z) {
        const double magnitude = std::exp(z.real);
        return {magnitude * std::cos(z.imaginary), magnitude * std::sin(z.imaginary)};
    }
};

}  // namespace phasetree::tracer
