// Directions of photons from a small lamp inside the object or close to it, and from a part of an emissive surface or
// medium. The sphere of directions is divided into bins of equal solid angle, each with a probability. With z = cos θ
// and the azimuth φ, a bin is a rectangle of (z, φ), and the pdf of directions in it is
//     p(ω) = p(bin) · (number of bins)/(4π).
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "caustics/discrete_distribution.hpp"

namespace phasetree::tracer {

class PhotonDirections {
  public:
    /// Makes bins_per_side² bins, all equally likely.
    explicit PhotonDirections(int bins_per_side)
        : bins_per_side_(bins_per_side), choice_(static_cast<std::size_t>(bins_per_side) * bins_per_side) {}

    std::size_t bins() const { return choice_.size(); }
    /// See DiscreteDistribution.
    void set_weights(std::span<const double> weights) { choice_.set_weights(weights); }

    struct Sample {
        glm::vec3 direction;  ///< unit length
        std::size_t bin;
    };
    /// u_bin in [0, 1) chooses the bin, u in [0, 1)² the position in it.
    Sample sample(float u_bin, const glm::vec2& u) const;
    /// The pdf of sample() per steradian.
    float density(const glm::vec3& direction) const;

  private:
    int bins_per_side_;
    DiscreteDistribution choice_;
};

}  // namespace phasetree::tracer
