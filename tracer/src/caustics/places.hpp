// A photon of an emissive medium travels on a line through a point that is sampled in a ball around a part of the
// medium. The cube around the ball is divided into cells, each with a probability, and points are uniform within a
// cell. A point outside of the ball emits no photon. So points have the density P(cell)/(volume of a cell) per volume.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "caustics/cell_choice.hpp"
#include "lights/bounding_sphere.hpp"

namespace phasetree::tracer {

class PhotonPlaces {
  public:
    /// All cells that meet the ball are equally likely.
    explicit PhotonPlaces(const BoundingSphere& ball);

    std::size_t cells() const { return choice_.size(); }
    /// Whether a cell overlaps the ball.
    bool meets_ball(std::size_t cell) const;
    /// The point in a cell at these shares, in [0, 1]³, of its sides.
    glm::vec3 place(std::size_t cell, const glm::vec3& share) const;
    /// See CellChoice; cells outside of the ball are never chosen.
    void set_weights(std::span<const double> weights);

    /// Samples a point: u_cell in [0, 1) chooses the cell, u in [0, 1)³ the position in it. nullopt outside of the
    /// ball.
    std::optional<glm::vec3> sample(float u_cell, const glm::vec3& u) const;
    /// The integral of the density of points along a line, from its origin to the distance `length`, which may be
    /// infinite. It is per area across the line. The direction has unit length.
    float density_along(const glm::vec3& origin, const glm::vec3& direction, float length) const;

  private:
    static constexpr int cells_a_side = 8;

    glm::ivec3 coordinates(std::size_t cell) const;
    float cell_side() const { return 2.0f * ball_.radius / static_cast<float>(cells_a_side); }
    glm::vec3 corner() const { return ball_.centre - ball_.radius; }

    BoundingSphere ball_;
    CellChoice choice_;
};

}  // namespace phasetree::tracer
