// A linear model of the picture around a pixel p: the radiance of a pixel q near it is
//
//     c(q) ≈ β₀ + Σᵢ βᵢ (fᵢ(q) − fᵢ(p)),
//
// where f are the features, such as the albedo. The coefficients are those of least squares, in which pixels count by
// weights, and slopes βᵢ cost a little, so that features that do not change around p are no trouble. Sources: Bitterli,
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
    /// A model around a pixel with these features.
    explicit LocalModel(const Features& at) : centre_(at) {}

    /// Adds a pixel.
    void add(float weight, const Features& features, const std::array<float, 3>& radiance);
    /// Once all pixels are there, of which at least one has a weight above 0.
    void solve();
    /// The radiance of a pixel of these features. After solve().
    std::array<float, 3> at(const Features& features) const;

  private:
    // Of an equation: one, the features, the radiance.
    static constexpr std::size_t unknowns = 1 + feature_count, columns = unknowns + 3;

    Features centre_;
    std::array<std::array<float, columns>, unknowns> sums_{};
    std::array<std::array<float, 3>, unknowns> coefficients_{};
};

}  // namespace phasetree::tracer
