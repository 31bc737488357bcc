#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "meshing/cube_patches.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

/// This room makes triangles of an object's interfaces, in these steps: the crossings along the lines of a grid and the
/// labels at its points (label_grid.hpp), which phases are joined across sides of cubes (joined_sides.hpp), labels that
/// give manifolds (well_composed.hpp), the patches in a cube (cube_patches.hpp), the place of the vertex of each patch
/// (vertex_in_cube.hpp), and the triangles between these (phase_mesh.cpp).
namespace phasetree::meshing {

/// A grid of points with equal distances. Its cubes are called by their corner of the lowest coordinates.
struct Grid {
    glm::dvec3 low{0};
    double spacing = 0;
    double digit = 0;  ///< what the last digit of the farthest coordinate is worth
    glm::ivec3 points{0};

    /// A grid whose outermost points are outside of the bounds. Throws ModelError; see mesh_of.
    static Grid around(const Bounds&, float spacing);

    std::size_t size() const {
        return static_cast<std::size_t>(points.x) * static_cast<std::size_t>(points.y) *
               static_cast<std::size_t>(points.z);
    }
    std::size_t index(const glm::ivec3& p) const {
        return (static_cast<std::size_t>(p.z) * static_cast<std::size_t>(points.y) + static_cast<std::size_t>(p.y)) *
                   static_cast<std::size_t>(points.x) +
               static_cast<std::size_t>(p.x);
    }
    glm::dvec3 place(const glm::ivec3& p) const { return low + spacing * glm::dvec3(p); }
};

/// A crossing along a line of the grid.
struct GridCrossing {
    float at = 0;  ///< along the line, in cubes from its first point
    Phase from, to;
    glm::vec3 normal{0};  ///< from `from` into `to`
};

/// The crossings along all lines of one direction.
class CrossingsAlong {
  public:
    CrossingsAlong(const Grid& grid, int axis) : grid_(grid), axis_(axis) {}
    /// Traces the lines. `advance` is called with how many lines more are traced; it may throw.
    void trace(const LineTracer&, const std::function<void(std::size_t)>& advance);

    std::size_t lines() const;
    std::size_t size() const { return crossings_.size(); }
    /// The crossings on the line through a point, in their order.
    std::span<const GridCrossing> of_line(const glm::ivec3& point) const;
    /// The crossings between a point and the next one along the axis.
    std::span<const GridCrossing> of_edge(const glm::ivec3& point) const;
    /// The crossing that stands for all of an edge, if there is any: of two, which are the faces of something thin, it
    /// is the second, of three the one in their midst.
    std::optional<GridCrossing> shown_on_edge(const glm::ivec3& point) const;

  private:
    std::size_t number_of_line(const glm::ivec3& point) const;

    const Grid& grid_;
    int axis_;
    std::vector<std::size_t> starts_;  ///< where the crossings of each line begin, and where those of the last end
    std::vector<GridCrossing> crossings_;
};

/// The phase at each point of the grid, x fastest.
using Labels = std::vector<Phase>;
/// Finds them by the crossings along the lines in x.
Labels labels_of(const Grid&, const CrossingsAlong& x);
/// The labels of a cube's corners.
Corners corners_of(const Grid&, const Labels&, const glm::ivec3& cube);
/// Whether all corners of a cube have one label, as those of most cubes have: such a cube is passed by at little cost.
bool is_uniform(const Grid&, const Labels&, const glm::ivec3& cube);

}  // namespace phasetree::meshing
