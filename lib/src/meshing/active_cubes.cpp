#include "meshing/active_cubes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "phasetree/model/handle.hpp"

namespace phasetree::meshing {

ActiveCubes::ActiveCubes(const Grid& grid, const Labels& labels, const JoinedSides& joined)
    : grid_(grid), rows_(static_cast<std::size_t>(grid.points.y) * static_cast<std::size_t>(grid.points.z) + 1, 0) {
    std::vector<std::vector<ActiveCube>> layers(static_cast<std::size_t>(grid.points.z - 1));
    tbb::parallel_for(0, grid.points.z - 1, [&](int k) {
        for (int j = 0; j + 1 < grid.points.y; ++j) {
            std::vector<ActiveCube>& found = layers[static_cast<std::size_t>(k)];
            const std::size_t before = found.size();
            for (int i = 0; i + 1 < grid.points.x; ++i)
                if (!is_uniform(grid, labels, {i, j, k}))
                    found.push_back({i, 0, CubePatches(joined.labels_of(labels, {i, j, k}))});
            rows_[row(j, k) + 1] = found.size() - before;
        }
    });
    for (std::size_t r = 1; r < rows_.size(); ++r) rows_[r] += rows_[r - 1];
    cubes_.reserve(rows_.back());
    for (const std::vector<ActiveCube>& layer : layers) cubes_.insert(cubes_.end(), layer.begin(), layer.end());
    for (ActiveCube& cube : cubes_) {
        cube.vertex = static_cast<std::uint32_t>(vertices_);
        vertices_ += static_cast<std::size_t>(cube.patches.count());
    }
    if (vertices_ > std::numeric_limits<std::uint32_t>::max())
        throw ModelError("the mesh would have more than four billion vertices; use a larger spacing");
}

std::uint32_t ActiveCubes::vertex(const glm::ivec3& cube, int edge) const {
    const std::size_t r = row(cube.y, cube.z);
    const auto begin = cubes_.begin() + static_cast<std::ptrdiff_t>(rows_[r]);
    const auto end = cubes_.begin() + static_cast<std::ptrdiff_t>(rows_[r + 1]);
    const auto found = std::lower_bound(begin, end, cube.x, [](const ActiveCube& c, int x) { return c.x < x; });
    return found->vertex + static_cast<std::uint32_t>(found->patches.patch(edge));
}

std::pair<glm::ivec3, int> ActiveCubes::place_of(std::uint32_t vertex) const {
    const auto cube = std::ranges::upper_bound(cubes_, vertex, {}, &ActiveCube::vertex) - 1;
    const auto number = static_cast<std::size_t>(cube - cubes_.begin());
    const auto r = static_cast<int>(std::ranges::upper_bound(rows_, number) - rows_.begin()) - 1;
    return {{cube->x, r % grid_.points.y, r / grid_.points.y}, static_cast<int>(vertex - cube->vertex)};
}

}  // namespace phasetree::meshing
