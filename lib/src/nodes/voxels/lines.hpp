#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace phasetree::voxels {

/// The number of voxels along x, y and z.
using Size = std::array<int, 3>;

std::size_t count_of(const Size&);

/// Convolves lines of voxels with a Gaussian of σ voxels, truncated at 3.5 σ, which omits 0.05 % of it. If σ is 0,
/// nothing is blurred. Beyond its ends, a line continues with its end values.
class Blur {
  public:
    explicit Blur(float sigma);
    /// Blurs the values, x fastest, along one axis. Uses all threads.
    void along(std::size_t axis, std::vector<float>& values, const Size&) const;

  private:
    std::vector<float> weights_;
};

/// Replaces values by the coefficients of the quadratic B-spline through them, along one axis: cₖ with
///     cₖ₋₁/8 + 6cₖ/8 + cₖ₊₁/8 = vₖ,
/// where c continues with its end values. Uses all threads.
void to_spline_along(std::size_t axis, std::vector<float>& values, const Size&);

}  // namespace phasetree::voxels
