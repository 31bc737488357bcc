// Dispersion: the refractive index by wavelength. By Sellmeier's equation,
//     n² = 1 + Σ Bᵢ λ²/(λ² − Cᵢ),   λ and √Cᵢ in micrometres, without distinguishing vacuum and air,
// with the measured coefficients of glasses.hpp; or by Cauchy's, n = A + B/λ², from the two numbers in glass
// catalogues: the index n_d at Fraunhofer's d line (587.56 nm), and Abbe's number V = (n_d − 1)/(n_F − n_C) with the
// lines F (486.13 nm) and C (656.27 nm).
//
// References: Born & Wolf, Principles of Optics, 7th ed., 2.3.4 and 4.7.1.
#pragma once

#include <array>
#include <cmath>

#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

class Dispersion {
  public:
    struct Term {
        double strength = 0.0, square = 0.0;  ///< B, and C in µm²
    };
    using Sellmeier = std::array<Term, 4>;

    explicit Dispersion(const Sellmeier& terms) : terms_(terms) {}
    /// Cauchy's equation. Abbe's number must be positive.
    Dispersion(double index_at_d, double abbe_number) {
        constexpr double d = wavelength_of_d_line * 1e-3, f = 0.4861327, c = 0.6562725;
        b_ = (index_at_d - 1.0) / abbe_number / (1.0 / (f * f) - 1.0 / (c * c));
        a_ = index_at_d - b_ / (d * d);
    }

    float index(float nanometres) const {
        const double square = static_cast<double>(nanometres) * static_cast<double>(nanometres) * 1e-6;
        if (a_ > 0.0) return static_cast<float>(a_ + b_ / square);
        double sum = 1.0;
        for (const Term& term : terms_) sum += term.strength * square / (square - term.square);
        return static_cast<float>(std::sqrt(sum));
    }

  private:
    Sellmeier terms_{};
    double a_ = 0.0, b_ = 0.0;  ///< Cauchy's; a is 0 if Sellmeier's terms apply
};

}  // namespace phasetree::tracer
