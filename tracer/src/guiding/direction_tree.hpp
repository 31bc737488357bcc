// Directions from which light arrives at a place, as a density that can be sampled: a quadtree over the sphere, finer
// where more light comes from (Müller, Gross & Novák: Practical Path Guiding for Efficient Light-Transport Simulation,
// Computer Graphics Forum 36(4), EGSR 2017, section 4.1).
//
// The sphere is mapped to the unit square by x = φ/2π and y = (1 + cos θ)/2, of θ from the z axis. The map keeps areas:
// a density over the square is 4π times that per steradian.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phasetree::tracer {

class DirectionTree {
  public:
    /// Light that was found to arrive from a direction, as a point of the square.
    struct Light {
        glm::vec2 on_square;
        float amount = 0;  ///< in any unit; greater than 0
    };

    /// The density in proportion to the lights, which are put into another order. There must be one.
    explicit DirectionTree(std::span<Light> lights);

    struct Sample {
        glm::vec3 direction;
        float pdf;  ///< the density in the square that the direction was taken from, per steradian; greater than 0
    };
    /// A direction for a point of the unit square [0, 1)². Neighbours mostly stay neighbours, so what is stratified
    /// stays so.
    Sample sample(glm::vec2 u) const;
    /// The density of sample() in a direction of unit length, per steradian. Asked for a sampled direction it may be
    /// that of the next square, for a direction is rounded.
    float pdf(const glm::vec3& direction) const;

  private:
    // A square and its four quarters, of which number q has its low corner at (q % 2, q / 2) of half the side.
    struct Node {
        std::array<float, 4> share{};          // of this square's light
        std::array<std::uint32_t, 4> child{};  // of the quarters that are divided; 0 of those that are not
    };

    std::uint32_t divide(double amount_of_all, std::span<Light> lights, glm::vec2 corner, int depth);

    std::vector<Node> nodes_;
};

/// The point of the unit square for a direction of unit length, and back.
glm::vec2 sphere_to_square(const glm::vec3& direction);
glm::vec3 square_to_sphere(const glm::vec2& point);

}  // namespace phasetree::tracer
