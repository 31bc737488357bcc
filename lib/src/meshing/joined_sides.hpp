// Where two phases alternate around a side of a cube (A, B, A, B), either could be joined across the side. We choose
// the one that a ray finds in the middle of the side. This keeps a thin plate of one phase within another connected,
// whatever its orientation: if two opposite corners are in a flat plate, so is the middle between them.
#pragma once

#include <functional>
#include <unordered_map>

#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

class JoinedSides {
  public:
    /// Keeps references to the grid and the lines.
    JoinedSides(const Grid& grid, const LineTracer& lines) : grid_(grid), lines_(lines) {}

    /// Examines the middles of all sides around which phases alternate. `cancelled` is called periodically, and may
    /// throw.
    void find_all(const Labels&, const std::function<void()>& cancelled);
    /// Call this after labels have changed: examines the middles of those sides of a cube around which phases now
    /// alternate.
    void find(const Labels&, const glm::ivec3& cube);
    /// The labels of a cube whose sides have been examined. Thread-safe.
    CubeLabels labels_of(const Labels&, const glm::ivec3& cube) const;

  private:
    /// A side is identified by its point with the lowest coordinates and by its perpendicular axis.
    std::size_t key(const glm::ivec3& point, int axis) const {
        return 3 * grid_.index(point) + static_cast<std::size_t>(axis);
    }
    Phase phase_in_middle(const glm::ivec3& point, int axis) const;

    const Grid& grid_;
    const LineTracer& lines_;
    std::unordered_map<std::size_t, Phase> middles_;  ///< the phase in the middle of a side, by key
};

}  // namespace phasetree::meshing
