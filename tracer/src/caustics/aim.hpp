// Chooses the directions of photons from a lamp, that is, a light with a position. If the lamp is small and inside the
// object or close to it, photons are emitted in any direction. Otherwise they are aimed at a bin of a square through
// the object. (A bin is a part of the square or of the sphere of directions that has a probability of its own.) A
// square cannot serve a lamp close by because lines to the object may miss it. Some lines of a large lamp miss the
// square and are left to the other techniques of path.hpp. Large lamps do not choose directions freely because the
// direction alone says little about where a line from them leads.
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
    /// For an object inside a sphere.
    PhotonAim(const BoundingSphere& lamp, const BoundingSphere& object);

    std::size_t bins() const;
    /// See DiscreteDistribution.
    void set_weights(std::span<const double> weights);

    struct Sample {
        glm::vec3 direction;  ///< of unit length
        float distance;       ///< to a point on the line in front of the lamp; in the square if there is one
        std::size_t bin;
    };
    /// Samples a direction from a point of the lamp: u_bin in [0, 1) chooses the bin, u in [0, 1)² the position in
    /// it. nullopt if rounding leaves no direction.
    std::optional<Sample> sample(const glm::vec3& from, float u_bin, const glm::vec2& u) const;
    /// The pdf of sample() per steradian.
    float density(const glm::vec3& from, const glm::vec3& direction) const;

  private:
    std::variant<PhotonTarget, PhotonDirections> chooser_;
    float distance_without_square_;  ///< Sample::distance if there is no square: twice the object's radius
};

}  // namespace phasetree::tracer
