#pragma once

#include "meshing/cube_patches.hpp"
#include "meshing/joined_sides.hpp"
#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

/// A cube with vertices, because it contains interfaces.
struct ActiveCube {
    int x = 0;
    std::uint32_t vertex = 0;  ///< the index of the first patch's vertex; those of the other patches follow
    CubePatches patches;
};

/// All cubes with vertices. Keeps a reference to the grid.
class ActiveCubes {
  public:
    /// Throws ModelError if there are too many vertices.
    ActiveCubes(const Grid&, const Labels&, const JoinedSides&);

    std::size_t vertices() const { return vertices_; }
    /// The vertex in a cube for the patch of an edge between two phases.
    std::uint32_t vertex(const glm::ivec3& cube, int edge) const;
    /// The lowest point of a vertex's cube, and the vertex's patch.
    std::pair<glm::ivec3, int> place_of(std::uint32_t vertex) const;
    /// Calls f(lowest point, cube) for each of the cubes in a layer.
    template <class F>
    void for_each_in_layer(int k, F&& f) const {
        for (int j = 0; j + 1 < grid_.points.y; ++j)
            for (std::size_t n = rows_[row(j, k)]; n < rows_[row(j, k) + 1]; ++n)
                f(glm::ivec3(cubes_[n].x, j, k), cubes_[n]);
    }

  private:
    std::size_t row(int j, int k) const {
        return static_cast<std::size_t>(k) * static_cast<std::size_t>(grid_.points.y) + static_cast<std::size_t>(j);
    }
    const Grid& grid_;
    std::vector<std::size_t> rows_;  // where the cubes of each row along x begin in cubes_
    std::vector<ActiveCube> cubes_;
    std::size_t vertices_ = 0;
};

}  // namespace phasetree::meshing
