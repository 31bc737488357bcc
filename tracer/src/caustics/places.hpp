// Where in a ball around a medium that shines a photon's line is chosen. The cube around the ball is divided into cells
// with a probability each, in which places are evenly spread; what of them is not in the ball sends no photon. So the
// density per volume of a place in the ball is that of its cell, P(cell)/(volume of a cell).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "caustics/cell_choice.hpp"
#include "lights/bounding_sphere.hpp"

namespace phasetree::tracer {

class PhotonPlaces {
  public:
    /// All cells are equally likely.
    explicit PhotonPlaces(const BoundingSphere& ball);

    std::size_t cells() const { return choice_.size(); }
    glm::vec3 centre(std::size_t cell) const;
    /// As CellChoice has it.
    void set_weights(std::span<const double> weights) { choice_.set_weights(weights); }

    /// A place: u_cell in [0, 1) chooses the cell, u in [0, 1)³ the place in it. Nothing if it is outside of the ball.
    std::optional<glm::vec3> sample(float u_cell, const glm::vec3& u) const;
    /// The density of places, per volume, integrated along a line from its origin to a distance, which may be infinite:
    /// per area across the line. The direction is of unit length.
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
