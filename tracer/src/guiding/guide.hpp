// Where the light on surfaces comes from, all over the scene, as far as paths have found out: what a path asks before
// it goes on.
//
// Space is divided where paths found light, until a part has few of their findings, and each part has a density of
// directions (direction_tree.hpp). Surfaces are told apart by where they face, because light falls on the two sides of
// a thin wall from different directions: space is divided six times, for normals near each direction of the axes.
// Since walls that face alike have much the same cosines, what is learnt is the light times the cosine at the surface,
// where Müller, Gross & Novák (direction_tree.hpp) learn the light alone. It is what a path's own directions find, by
// the weight that they have against shadow rays and photons: where a lamp is in plain sight, shadow rays find it, and a
// guide need not.
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

/// Light that a path found from a place on a surface.
struct Finding {
    glm::vec3 position;
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
    /// What the findings tell. Depends on their order, and on nothing else. Uses all threads of the arena that it is
    /// called in.
    explicit Guide(const std::vector<Finding>& findings);

    /// The density of directions for a place; null where nothing is known. Good as long as the guide lives.
    const DirectionTree* at(const glm::vec3& position, Facing facing) const;

  private:
    // A part of space: divided into two, each with a node of its own, or with one tree of directions, or with none.
    struct Node {
        int axis = undivided;  // along which it is divided
        float at = 0;          // and where
        std::size_t low = 0, high = 0;
        std::optional<std::size_t> tree{};  // of a part that is not divided
    };
    static constexpr int undivided = 3;
    struct Builder;

    std::array<std::vector<Node>, facings> parts_;  // the first node is all of space
    std::vector<DirectionTree> trees_;
};

}  // namespace phasetree::tracer
