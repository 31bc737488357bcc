// How a spectrum becomes a colour: CIE's colour matching functions of 1931, and Rec.709's red, green and blue by them.
//
//   x̄(λ) = 1.056 g(599.8, 37.9, 31.0) + 0.362 g(442.0, 16.0, 26.7) − 0.065 g(501.1, 20.4, 26.2)
//   ȳ(λ) = 0.821 g(568.8, 46.9, 40.5) + 0.286 g(530.9, 16.3, 31.1)
//   z̄(λ) = 1.217 g(437.0, 11.8, 36.0) + 0.681 g(459.0, 26.0, 13.8)
//
// with g(μ, σ₁, σ₂) = exp(−(λ − μ)²/(2σ²)), σ = σ₁ below μ and σ₂ above it; wavelengths are in nanometres.
//
// References: Wyman, Sloan & Shirley, Simple Analytic Approximations to the CIE XYZ Color Matching Functions, JCGT
// 2(2), 2013, section 2.2; ITU-R BT.709-6, item 1.4 (the primaries, from which the matrix follows).
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

inline double colour_matching_lobe(double wavelength, double middle, double below, double above) {
    const double t = (wavelength - middle) / (wavelength < middle ? below : above);
    return std::exp(-0.5 * t * t);
}

/// x̄, ȳ, z̄.
inline glm::dvec3 colour_matching(double wavelength) {
    const auto g = [&](double middle, double below, double above) {
        return colour_matching_lobe(wavelength, middle, below, above);
    };
    return {1.056 * g(599.8, 37.9, 31.0) + 0.362 * g(442.0, 16.0, 26.7) - 0.065 * g(501.1, 20.4, 26.2),
            0.821 * g(568.8, 46.9, 40.5) + 0.286 * g(530.9, 16.3, 31.1),
            1.217 * g(437.0, 11.8, 36.0) + 0.681 * g(459.0, 26.0, 13.8)};
}

inline glm::dvec3 rec709_from_xyz(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

/// A wavelength, and how much it counts for red, green and blue.
struct SpectralWeight {
    double wavelength;
    glm::dvec3 weight;
};

/// Weights by which light of D65 is as much red as green and blue: those of each colour add up to 1. Some are negative,
/// as Rec.709's primaries do not hold all colours.
inline std::vector<SpectralWeight> spectral_weights() {
    constexpr double first = 380.0, last = 780.0, step = 2.0;
    std::vector<SpectralWeight> weights;
    glm::dvec3 sum(0.0);
    for (double wavelength = first; wavelength <= last; wavelength += step) {
        weights.push_back({wavelength, daylight_at(wavelength) * rec709_from_xyz(colour_matching(wavelength))});
        sum += weights.back().weight;
    }
    for (SpectralWeight& w : weights) w.weight /= sum;
    return weights;
}

}  // namespace phasetree::tracer
