// The target of photons from a distant light: a square in a plane through the centre of the object, divided into bins
// with a probability each. Photons pass through it on straight lines. The density of a line among parallel ones, per
// area perpendicular to it, is
//     p = p(bin)/(area of a bin · |cos θ|),   θ between the line and the plane's normal.
// Lines that miss the square have the density 0 because no photon travels on them.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "caustics/discrete_distribution.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

class PhotonTarget {
  public:
    static constexpr int bins_per_side = 32;

    /// Makes a square of this half side, with equally likely bins. The normal has unit length.
    PhotonTarget(const glm::vec3& centre, const glm::vec3& normal, float half_side);

    std::size_t bins() const { return choice_.size(); }
    /// See DiscreteDistribution.
    void set_weights(std::span<const double> weights) { choice_.set_weights(weights); }

    struct Sample {
        glm::vec3 point;
        std::size_t bin;
    };
    /// Samples a point of the square: u_bin in [0, 1) chooses the bin, u in [0, 1)² the position in it.
    Sample sample(float u_bin, const glm::vec2& u) const;
    struct Crossing {
        float density;   ///< of the line among parallel ones, per area perpendicular to it
        float distance;  ///< along the line, from its origin to the plane; negative behind it
    };
    /// Where a line crosses the plane. The direction has unit length.
    Crossing crossing(const glm::vec3& origin, const glm::vec3& direction) const;

  private:
    glm::vec3 centre_;
    Frame frame_;
    float half_side_;
    DiscreteDistribution choice_;
};

}  // namespace phasetree::tracer
