// Where the light on surfaces comes from, all over the scene, as far as paths have found out: what a path asks before
// it goes on.
//
// Space is divided into regions, smaller ones where paths found more light, and each region has a density of directions
// (direction_tree.hpp). Surfaces are told apart by where they face, because light falls on the two sides of a thin wall
// from different directions: space is divided six times, for normals near each direction of the axes. What is learnt is
// the light times the cosine at the surface, because surfaces that face alike have nearly the same cosines; Müller,
// Gross & Novák (direction_tree.hpp) learn the light alone.
//
// Only light that the paths' own directions find is learnt, times its weight against shadow rays and photons. Where a
// lamp is in plain sight shadow rays find it, and a guide need not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "guiding/direction_tree.hpp"

namespace phasetree::tracer {

/// Where a surface faces: the direction of the axes that is nearest to its normal, +x, −x, +y, −y, +z or −z.
using Facing = std::uint8_t;
inline constexpr std::size_t facings = 6;
Facing facing_of(const glm::vec3& normal);

/// Light that a path found from a point of a surface.
struct Finding {
    glm::vec3 point;
    Facing facing = 0;
    glm::vec3 direction;  ///< towards the light
    /// An estimate of the irradiance from all directions, by this one: the radiance times the cosine at the surface,
    /// over the density with which the direction was chosen. Greater than 0, and in any unit.
    float light = 0;
};

class Guide {
  public:
    /// Knows nothing.
    Guide() = default;
    /// What the findings tell. It depends on their order, and on nothing else. The densities are made by all threads of
    /// the arena that it is called in.
    explicit Guide(const std::vector<Finding>& findings);

    /// The density of directions for a point of a surface; null where nothing is known. It is good as long as the guide
    /// lives.
    const DirectionTree* at(const glm::vec3& point, Facing facing) const;

  private:
    // A region of space: one that is divided into two, each with a node of its own, or one that has a tree of
    // directions, or one of which nothing is known.
    struct Node {
        int axis = undivided;  // 0, 1 or 2: it is divided across that axis
        float at = 0;          // where
        std::size_t low = 0, high = 0;
        std::optional<std::size_t> tree{};  // the number of a region's tree
    };
    static constexpr int undivided = 3;
    struct Builder;

    std::array<std::vector<Node>, facings> nodes_;  // for each facing; the first is all of space
    std::vector<DirectionTree> trees_;
};

}  // namespace phasetree::tracer
