// A pdf on the sphere of directions that depends only on their height z, for importance sampling.
//
// The sphere is divided into zones of equal height, which have equal solid angles (Archimedes). In each, the pdf is
// constant, and directions are uniform in z and in azimuth.
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

    /// nullopt if all importances are zero.
    std::optional<DirectionSample> sample(const glm::vec2& u) const;

    /// The pdf of a unit direction per steradian, as reported by sample().
    float pdf(const glm::vec3& direction) const;

    /// The integral over the sphere of the tabulated importance.
    float integral() const { return integral_; }

  private:
    float integral_ = 0.0f;
    std::vector<float> cumulative_;  ///< one more than zones
    std::vector<float> density_;     ///< of each zone
};

}  // namespace phasetree::tracer
