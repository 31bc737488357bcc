// This chooses the direction of a photon of a lamp, that is of a light with a place. If the lamp is small and within
// the object or close to it the photon flies in any direction; else to a cell of a square through the object. Of a lamp
// close by no square is met by all lines that lead to the object. Of a large lamp some lines miss the square, and are
// left to the other techniques of path.hpp: the direction alone says little of where a large lamp's line leads.
#pragma once

#include <optional>
#include <span>
#include <variant>

#include "caustics/directions.hpp"
#include "caustics/target.hpp"
#include "lights/bounding_sphere.hpp"

namespace phasetree::tracer {

class PhotonAim {
  public:
    /// For an object within a sphere.
    PhotonAim(const BoundingSphere& lamp, const BoundingSphere& object);

    std::size_t cells() const;
    /// As CellChoice has it.
    void set_weights(std::span<const double> weights);

    struct Aimed {
        glm::vec3 direction;  ///< of unit length
        float distance;       ///< to a point on the line that is beyond the lamp, in the square if there is one
        std::size_t cell;
    };
    /// A direction from a point of the lamp: u_cell in [0, 1) chooses the cell, u in [0, 1)² the place in it. Nothing
    /// if rounding leaves none.
    std::optional<Aimed> sample(const glm::vec3& from, float u_cell, const glm::vec2& u) const;
    /// The density of sample() per steradian.
    float density(const glm::vec3& from, const glm::vec3& direction) const;

  private:
    std::variant<PhotonTarget, PhotonDirections> to_;
    float beyond_;  ///< twice the object's radius
};

}  // namespace phasetree::tracer
