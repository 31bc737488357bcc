// Samples points in a ball around a part of an emissive medium: a photon of the medium travels on a line through such a
// point. The cube around the ball is divided into bins, each with a probability, and points are uniform within a bin. A
// point outside of the ball emits no photon. So points have the density P(bin)/(volume of a bin) per volume.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "caustics/discrete_distribution.hpp"
#include "lights/bounding_sphere.hpp"

namespace phasetree::tracer {

class PointsInBall {
  public:
    /// All bins that meet the ball are equally likely.
    explicit PointsInBall(const BoundingSphere& ball);

    std::size_t bins() const { return choice_.size(); }
    /// Whether a bin overlaps the ball.
    bool meets_ball(std::size_t bin) const;
    /// The point in a bin at these coordinates relative to it, in [0, 1]³.
    glm::vec3 point(std::size_t bin, const glm::vec3& u) const;
    /// See DiscreteDistribution. Bins outside of the ball are never chosen.
    void set_weights(std::span<const double> weights);

    /// Samples a point: u_bin in [0, 1) chooses the bin, u in [0, 1)³ the position in it. nullopt outside of the
    /// ball.
    std::optional<glm::vec3> sample(float u_bin, const glm::vec3& u) const;
    /// The integral of the density of points along a line, from its origin to the distance `length`, which may be
    /// infinite. It is per area across the line. The direction has unit length.
    float density_along(const glm::vec3& origin, const glm::vec3& direction, float length) const;

  private:
    static constexpr int bins_per_side = 8;

    glm::ivec3 coordinates(std::size_t bin) const;
    float bin_side() const { return 2.0f * ball_.radius / static_cast<float>(bins_per_side); }
    glm::vec3 corner() const { return ball_.centre - ball_.radius; }

    BoundingSphere ball_;
    DiscreteDistribution choice_;
};

}  // namespace phasetree::tracer
