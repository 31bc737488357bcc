#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace phasetree {

/// N⁻¹, the inverse of the cumulative normal distribution, for u from 0.001 to 0.999, by Newton's method. Starting from
/// 0, no step overshoots the root, because N is concave on one side of 0 and convex on the other. Within this range, 11
/// steps reach the rounding errors of doubles. N is summed by Marsaglia's series, because the library's error functions
/// differ between processors (phasetree/math/portable.hpp).
///
/// Reference: Marsaglia, Evaluating the Normal Distribution, Journal of Statistical Software 11(4), 2004.
inline double inverse_normal(double u) {
    double x = 0;
    for (int i = 0; i < 12; ++i) {
        const double slope = std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
        double series = 0;
        for (double term = x, divisor = 3; series + term != series; divisor += 2) {
            series += term;
            term *= x * x / divisor;
        }
        x -= (0.5 + slope * series - u) / slope;
    }
    return x;
}

/// The depth of a point in a phase, in voxels, from the value of the phase's blurred indicator there, its share. The
/// depth is the distance to a flat interface with that share, σ N⁻¹(share). It is needed for each voxel and phase, so
/// it is tabulated.
class DepthOfShare {
  public:
    explicit DepthOfShare(float sigma) : most_(most(sigma)) {
        for (std::size_t i = 0; i < table_.size(); ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
            // Depths are clamped beyond shares of 0.006 and 0.994, which is inside this range.
            const double inner = std::clamp(share, 0.001, 0.999);
            // Without blurring, a share is 0 or 1.
            const double depth = sigma > 0 ? static_cast<double>(sigma) * inverse_normal(inner) : share - 0.5;
            table_[i] = std::clamp(static_cast<float>(depth), -most_, most_);
        }
    }
    /// The maximum depth, in voxels. Farther away, a share is so close to 0 or 1 that the table, and the end of the
    /// Gaussian, cannot resolve depths.
    static float most(float sigma) { return sigma > 0 ? 2.5f * sigma : 0.5f; }
    float most() const { return most_; }
    float operator()(float share) const {
        const float at = std::clamp(share, 0.f, 1.f) * static_cast<float>(table_.size() - 1);
        const auto i = std::min(static_cast<std::size_t>(at), table_.size() - 2);
        const float t = at - static_cast<float>(i);
        return table_[i] + t * (table_[i + 1] - table_[i]);
    }

  private:
    float most_;
    std::array<float, 4097> table_;
};

}  // namespace phasetree
