#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "meshing/cube_patches.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

/// The headers of this folder turn an object's interfaces into triangles, in these steps:
///  * label_grid.hpp: the crossings along the lines of a grid, and the labels at its points;
///  * joined_sides.hpp: which phases are joined across sides of cubes;
///  * well_composed.hpp: changes to labels so that surfaces are manifolds;
///  * cube_patches.hpp: the patches in a cube;
///  * vertex_in_cube.hpp: the position of the vertex of each patch;
///  * separation.hpp: moves and adds vertices so that triangles do not cross;
///  * phase_mesh.cpp: runs these steps.
namespace phasetree::meshing {

/// A grid of equidistant points. Its cubes are identified by their corner with the lowest coordinates. In this folder,
/// a cube has six sides (its square faces), twelve edges and eight corners; "faces" are those of the object.
struct Grid {
    glm::dvec3 low{0};
    double spacing = 0;
    double digit = 0;  ///< unit in the last place of the farthest coordinate
    glm::ivec3 points{0};

    /// A grid whose outermost points are outside the bounds. Throws ModelError; see mesh_of.
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
    float at = 0;  ///< position along the line, in cubes from its first point
    Phase from, to;
    glm::vec3 normal{0};  ///< points from `from` into `to`
};

/// The crossings along all lines of one direction.
class CrossingsAlong {
  public:
    CrossingsAlong(const Grid& grid, int axis) : grid_(grid), axis_(axis) {}
    /// Traces the lines. `advance` receives the number of newly traced lines; it may throw.
    void trace(const LineTracer&, const std::function<void(std::size_t)>& advance);

    std::size_t lines() const;
    std::size_t size() const { return crossings_.size(); }
    /// The crossings on the line through a point, in order.
    std::span<const GridCrossing> of_line(const glm::ivec3& point) const;
    /// The crossings between a point and the next one along the axis.
    std::span<const GridCrossing> of_edge(const glm::ivec3& point) const;
    /// The crossing that represents an edge, if it has any. Two crossings are the faces of something thin; the second
    /// one represents the edge. If there are three, it is the middle one.
    std::optional<GridCrossing> shown_on_edge(const glm::ivec3& point) const;

  private:
    std::size_t number_of_line(const glm::ivec3& point) const;

    const Grid& grid_;
    int axis_;
    std::vector<std::size_t> starts_;  ///< where the crossings of each line begin, and where those of the last line end
    std::vector<GridCrossing> crossings_;
};

/// The phase at each point of the grid, x fastest.
using Labels = std::vector<Phase>;
/// Determines the labels from the crossings along the lines in x.
Labels labels_of(const Grid&, const CrossingsAlong& x);
/// The labels of a cube's corners.
Corners corners_of(const Grid&, const Labels&, const glm::ivec3& cube);
/// Whether all corners of a cube have the same label. Most cubes are like that and are skipped at little cost.
bool is_uniform(const Grid&, const Labels&, const glm::ivec3& cube);

}  // namespace phasetree::meshing
