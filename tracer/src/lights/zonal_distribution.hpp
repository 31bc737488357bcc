// A probability density on the sphere of directions that depends on their height z alone, for importance sampling.
//
// The sphere is cut into zones of equal height, which have equal solid angles (Archimedes); in each the density is
// constant. Within its zone a direction is uniform in z and in azimuth.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "lights/direction_sample.hpp"

namespace phasetree::tracer {

class ZonalDistribution {
  public:
    /// A non-negative importance for each zone, from z = −1 up: the mean over the zone of the function to be sampled.
    explicit ZonalDistribution(std::span<const double> means);

    /// Nothing when every importance is zero.
    std::optional<DirectionSample> sample(const glm::vec2& u) const;

    /// The density of a unit direction per steradian; the one sample() reports.
    float pdf(const glm::vec3& direction) const;

    /// The integral over the sphere of the tabulated importance.
    float integral() const { return integral_; }

  private:
    float integral_ = 0.0f;
    std::vector<float> cumulative_;  ///< one more than zones
    std::vector<float> density_;     ///< of each zone
};

}  // namespace phasetree::tracer
