// A pdf of the directions from which light arrives at a point: a quadtree over the sphere, finer where more light comes
// from (Müller, Gross & Novák: Practical Path Guiding for Efficient Light-Transport Simulation, Computer Graphics Forum
// 36(4), EGSR 2017, section 4.1).
//
// The sphere is mapped to the unit square by x = φ/2π and y = (1 + cos θ)/2, with θ from the z axis. The map preserves
// areas: a density over the square is 4π times that per steradian.
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
    /// Light that arrives from a direction, as a point of the square.
    struct Light {
        glm::vec2 on_square;
        float amount = 0;  ///< in any unit; positive
    };

    /// Makes the pdf proportional to the lights, which must not be empty and are reordered.
    explicit DirectionTree(std::span<Light> lights);

    struct Sample {
        glm::vec3 direction;
        float pdf;  ///< pdf of the square from which the direction was sampled, per steradian; positive
    };
    /// The direction for a point of the unit square [0, 1)². Neighbours mostly stay neighbours, which preserves
    /// stratification.
    Sample sample(glm::vec2 u) const;
    /// The pdf of sample() in a direction of unit length, per steradian. Because directions are rounded, the result for
    /// a sampled direction may be that of a neighbouring square.
    float pdf(const glm::vec3& direction) const;

  private:
    // A square and its four quarters. Quarter q has its low corner at (q % 2, q / 2) of half the side.
    struct Node {
        std::array<float, 4> share{};          // of this square's light
        std::array<std::uint32_t, 4> child{};  // nodes of the quarters that are divided; 0 for the others
    };

    std::uint32_t divide(double amount_of_all, std::span<Light> lights, glm::vec2 corner, int depth);

    std::vector<Node> nodes_;
};

/// Maps a direction of unit length to the unit square, and back.
glm::vec2 sphere_to_square(const glm::vec3& direction);
glm::vec3 square_to_sphere(const glm::vec2& point);

}  // namespace phasetree::tracer
