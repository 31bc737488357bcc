#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace phasetree::voxels {

/// How many voxels there are along x, y and z.
using Size = std::array<int, 3>;

std::size_t count_of(const Size&);

/// Convolution of lines of voxels with a Gaussian of σ voxels, cut off at 3.5 σ, beyond which are 0.05 % of it. If σ is
/// 0, nothing is blurred. Beyond its ends a line goes on as it ends.
class Blur {
  public:
    explicit Blur(float sigma);
    /// Replaces the values, x fastest, by those blurred along one axis. Works on all threads.
    void along(std::size_t axis, std::vector<float>& values, const Size&) const;

  private:
    std::vector<float> weights_;
};

/// Replaces values by the coefficients of the quadratic B-spline through them, along one axis: cₖ with
///     cₖ₋₁/8 + 6cₖ/8 + cₖ₊₁/8 = vₖ,
/// where c goes on beyond the ends as it ends. Works on all threads.
void to_spline_along(std::size_t axis, std::vector<float>& values, const Size&);

}  // namespace phasetree::voxels
