// A linear model of the picture around a pixel p: the radiance of a pixel q near it is
//
//     c(q) ≈ β₀ + Σᵢ βᵢ (fᵢ(q) − fᵢ(p)),
//
// where f are the features, such as the albedo. The coefficients are those of weighted least squares, with a small
// regularisation of the slopes βᵢ, so that features that are constant around p cause no problems. Sources: Bitterli,
// Rousselle, Moon, Iglesias-Guitián, Adler, Mitchell, Jarosz & Novák, Nonlinearly Weighted First-order Regression for
// Denoising Monte Carlo Renderings, Computer Graphics Forum 35(4), 2016; Moon, Carr & Yoon, Adaptive Rendering Based on
// Weighted Local Regression, ACM Transactions on Graphics 33(5), 2014.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "denoise/halves.hpp"

namespace phasetree::tracer {

using Features = std::array<float, feature_count>;

class LocalModel {
  public:
    /// Makes a model around a pixel with these features.
    explicit LocalModel(const Features& at) : centre_(at) {}

    /// Adds a pixel.
    void add(float weight, const Features& features, const std::array<float, 3>& radiance);
    /// Call this after adding all pixels, of which at least one has a positive weight.
    void solve();
    /// The radiance of a pixel with these features. Requires solve().
    std::array<float, 3> at(const Features& features) const;

  private:
    // Columns of an equation: one, the features, the radiance.
    static constexpr std::size_t unknowns = 1 + feature_count, columns = unknowns + 3;

    Features centre_;
    std::array<std::array<float, columns>, unknowns> sums_{};
    std::array<std::array<float, 3>, unknowns> coefficients_{};
};

}  // namespace phasetree::tracer
