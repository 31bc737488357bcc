// Where two phases take turns around a side of a cube (A, B, A, B), either could be joined across the side. We take the
// one that a ray finds in the middle of the side. So a thin plate of one phase within another is whole, however it is
// turned: if two opposite corners are in a flat plate, so is the middle between them.
#pragma once

#include <functional>
#include <unordered_map>

#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

class JoinedSides {
  public:
    /// Refers to the grid and the lines.
    JoinedSides(const Grid& grid, const LineTracer& lines) : grid_(grid), lines_(lines) {}

    /// Looks at the middles of all such sides. `cancelled` is called periodically, and may throw.
    void find_all(const Labels&, const std::function<void()>& cancelled);
    /// Looks at the middles of such sides of a cube that came to be by changes of labels.
    void find(const Labels&, const glm::ivec3& cube);
    /// The labels of a cube whose sides were examined. Any number of threads may call it at once.
    CubeLabels labels_of(const Labels&, const glm::ivec3& cube) const;

  private:
    /// Sides are told apart by their point of the lowest coordinates and by the axis that is perpendicular to them.
    std::size_t key(const glm::ivec3& point, int axis) const {
        return 3 * grid_.index(point) + static_cast<std::size_t>(axis);
    }
    Phase phase_in_middle(const glm::ivec3& point, int axis) const;

    const Grid& grid_;
    const LineTracer& lines_;
    std::unordered_map<std::size_t, Phase> middles_;  ///< the phase in the middle of a side, by its key
};

}  // namespace phasetree::meshing
