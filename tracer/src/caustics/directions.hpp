// Directions of photons from a small lamp inside the object or close to it, and from a part of an emissive surface or
// medium. The sphere of directions is divided into cells of equal solid angle, each with a probability. With z = cos θ
// and the azimuth φ, a cell is a rectangle of (z, φ), and the pdf of directions in it is
//     p(ω) = p(cell) · (number of cells)/(4π).
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "caustics/cell_choice.hpp"

namespace phasetree::tracer {

class PhotonDirections {
  public:
    /// Makes cells_a_side² cells, all equally likely.
    explicit PhotonDirections(int cells_a_side)
        : cells_a_side_(cells_a_side), choice_(static_cast<std::size_t>(cells_a_side) * cells_a_side) {}

    std::size_t cells() const { return choice_.size(); }
    /// See CellChoice.
    void set_weights(std::span<const double> weights) { choice_.set_weights(weights); }

    struct Chosen {
        glm::vec3 direction;  ///< unit length
        std::size_t cell;
    };
    /// u_cell in [0, 1) chooses the cell, u in [0, 1)² the position in it.
    Chosen sample(float u_cell, const glm::vec2& u) const;
    /// The pdf of sample() per steradian.
    float density(const glm::vec3& direction) const;

  private:
    int cells_a_side_;
    CellChoice choice_;
};

}  // namespace phasetree::tracer
