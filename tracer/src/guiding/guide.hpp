// The distribution of incident light on surfaces all over the scene, learned from earlier paths, with which paths
// choose directions.
//
// Space is divided into regions, which are smaller where paths found more light, and each region has a pdf of
// directions (direction_tree.hpp). Space is divided six times, for surfaces with normals near each direction of the
// axes, because the two sides of a thin wall receive light from different directions. The learned quantity is the light
// times the cosine at the surface, because surfaces with the same facing have nearly the same cosines; Müller, Gross &
// Novák (direction_tree.hpp) learn the light alone.
//
// Guides learn only from light found by the paths' own directions, times its MIS weight against shadow rays and
// photons. Shadow rays find lamps that are directly visible, so a guide need not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "guiding/direction_tree.hpp"

namespace phasetree::tracer {

/// The facing of a surface: the direction of the axes nearest to its normal, +x, −x, +y, −y, +z or −z.
using Facing = std::uint8_t;
inline constexpr std::size_t facings = 6;
Facing facing_of(const glm::vec3& normal);

/// Light that a path found from a point of a surface.
struct GuideSample {
    glm::vec3 point;
    Facing facing = 0;
    glm::vec3 direction;  ///< towards the light
    /// An estimate of the irradiance from this direction alone: the radiance times the cosine at the surface, over the
    /// pdf of the direction. Positive, and in any unit.
    float light = 0;
};

class Guide {
  public:
    /// A guide without any information.
    Guide() = default;
    /// Learns from samples. The result depends only on them and their order. Uses all threads of the calling arena.
    explicit Guide(const std::vector<GuideSample>& samples);

    /// The pdf of directions for a point of a surface; null where nothing is known. Valid during the lifetime of the
    /// guide.
    const DirectionTree* at(const glm::vec3& point, Facing facing) const;

  private:
    // A region of space: divided into two, each with a node of its own, or with a tree of directions, or without
    // information.
    struct Node {
        int axis = undivided;  // 0, 1 or 2: the axis across which it is divided
        float at = 0;          // position of the division
        std::size_t low = 0, high = 0;
        std::optional<std::size_t> tree{};  // index of a region's tree
    };
    static constexpr int undivided = 3;
    struct Builder;

    std::array<std::vector<Node>, facings> nodes_;  // for each facing; the first is all of space
    std::vector<DirectionTree> trees_;
};

}  // namespace phasetree::tracer
