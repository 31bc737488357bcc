// Where the photons of a lamp fly, which has a place: to the cells of a square through the object, or, if the lamp is
// small and within the object or close to it, in all directions. Of a lamp close by no square is met by all lines that
// lead to the object. Of a large one those that miss the square are left to the other techniques of path.hpp: cells of
// directions say little of where its lines lead.
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
        float distance;       ///< to a point in that direction near the object
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
