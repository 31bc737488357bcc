// A piecewise-constant pdf on the sphere of directions, for importance sampling an environment.
//
// The sphere is divided into width × height lat-long cells (see lat_long.hpp). Within a cell, the pdf per *solid angle*
// is constant, p = P(cell)/Ω(cell): a cell is sampled uniformly in azimuth and in cos θ, so no sin θ appears that could
// vanish at the poles. A row is chosen from the marginal, then a column within the row, each by inverting its
// cumulative distribution (Pharr, Jakob, Humphreys: Physically Based Rendering, 3rd ed., 13.6.7).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "lights/direction_sample.hpp"

namespace phasetree::tracer {

class LatLongDistribution {
  public:
    /// `means` contains, row by row from the zenith down, a non-negative importance for each cell: the mean over the
    /// cell of the function to be sampled. It must be positive wherever the function is not zero.
    LatLongDistribution(int width, int height, std::span<const float> means);

    /// nullopt if all importances are zero.
    std::optional<DirectionSample> sample(const glm::vec2& u) const;

    /// The pdf of `direction` per steradian, as reported by sample().
    float pdf(const glm::vec3& direction) const;

    /// The integral over the sphere of the tabulated importance.
    float integral() const { return integral_; }

    int width() const { return width_; }
    int height() const { return height_; }
    /// The pdf of directions in a cell, per steradian.
    float cell_pdf(std::size_t column, std::size_t row) const;

  private:
    std::span<const float> columns_of(std::size_t row) const;

    int width_;
    int height_;
    float integral_ = 0.0f;
    std::vector<float> rows_;        ///< cumulative, height + 1
    std::vector<float> columns_;     ///< cumulative within each row, height × (width + 1)
    std::vector<double> cos_theta_;  ///< of the row boundaries, height + 1
};

}  // namespace phasetree::tracer
