// Sides of cubes around which two phases take turns, so that either could be joined across: it is the one that is in
// the middle of the side. So a thin plate of one phase within another is whole, however it is turned.
#pragma once

#include <functional>
#include <unordered_map>

#include "meshing/label_grid.hpp"

namespace phasetree::meshing {

class JoinedSides {
  public:
    /// Refers to the grid and the lines.
    JoinedSides(const Grid& grid, const LineTracer& lines) : grid_(grid), lines_(lines) {}

    /// Looks at all such sides that there are. `cancelled` is called now and then, and may throw.
    void find_all(const Labels&, const std::function<void()>& cancelled);
    /// Looks at those of a cube that were not looked at yet, because labels were changed since.
    void find(const Labels&, const glm::ivec3& cube);
    /// The labels of a cube whose sides were looked at. Any number of threads may call it at once.
    CubeLabels labels_of(const Labels&, const glm::ivec3& cube) const;

  private:
    /// A side is called by its point of the lowest coordinates and the axis that it is across.
    std::size_t key(const glm::ivec3& point, int axis) const {
        return 3 * grid_.index(point) + static_cast<std::size_t>(axis);
    }
    Phase phase_in_middle(const glm::ivec3& point, int axis) const;

    const Grid& grid_;
    const LineTracer& lines_;
    std::unordered_map<std::size_t, Phase> middles_;
};

}  // namespace phasetree::meshing
