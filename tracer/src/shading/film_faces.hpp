// The two faces of a thin film: thin_film.hpp has the equations.
#pragma once

#include "shading/complex.hpp"

namespace phasetree::tracer {

/// The part of a film's optics that depends only on the angle: r₁₂, r₂₃ of both polarisations, and q₂.
struct FilmFaces {
    Complex outer[2], inner[2], inside;

    FilmFaces(double outside, double film, const Complex& behind, double cos_theta) {
        const double sine2 = outside * outside * (1.0 - cos_theta * cos_theta);
        const Complex n[3] = {{outside}, {film}, behind};
        Complex q[3];
        for (int i = 0; i < 3; ++i) q[i] = sqrt(n[i] * n[i] - Complex{sine2});
        const auto s = [&](int j, int k) { return (q[j] - q[k]) / (q[j] + q[k]); };
        const auto p = [&](int j, int k) {
            const Complex a = n[k] * n[k] * q[j], b = n[j] * n[j] * q[k];
            return (a - b) / (a + b);
        };
        outer[0] = s(0, 1);
        outer[1] = p(0, 1);
        inner[0] = s(1, 2);
        inner[1] = p(1, 2);
        inside = q[1];
    }
};

}  // namespace phasetree::tracer
