#include "meshing/joined_sides.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "phasetree/math/float_mode.hpp"

namespace phasetree::meshing {

namespace {

// The axis perpendicular to each side of a cube, and the side's position along it, in the order of sides_of_cube.
constexpr int axis_of_side(int side) {
    return 2 - side / 2;
}
glm::ivec3 offset_of_side(int side) {
    glm::ivec3 offset(0);
    offset[axis_of_side(side)] = side % 2;
    return offset;
}

}  // namespace

Phase JoinedSides::phase_in_middle(const glm::ivec3& point, int axis) const {
    const FlushSubnormals flush;
    glm::dvec3 middle = grid_.place(point);
    for (int i = 0; i < 3; ++i)
        if (i != axis) middle[i] += 0.5 * grid_.spacing;
    const glm::vec3 start(glm::dvec3(grid_.low.x, middle.y, middle.z));
    std::vector<CrossingOnLine> crossings;
    lines_(start, {1, 0, 0}, static_cast<float>(middle.x - grid_.low.x), crossings);
    return crossings.empty() ? vacuum : crossings.back().to;
}

void JoinedSides::find_all(const Labels& labels, const std::function<void()>& cancelled) {
    using Side = std::pair<glm::ivec3, int>;
    std::vector<std::vector<Side>> layers(static_cast<std::size_t>(grid_.points.z - 1));
    tbb::parallel_for(0, grid_.points.z - 1, [&](int k) {
        cancelled();
        for (int j = 0; j + 1 < grid_.points.y; ++j)
            for (int i = 0; i + 1 < grid_.points.x; ++i) {
                if (is_uniform(grid_, labels, {i, j, k})) continue;
                const Corners corners = corners_of(grid_, labels, {i, j, k});
                for (const int side : {0, 2, 4})  // the sides at the cube's low ends
                    if (take_turns(corners, side))
                        layers[static_cast<std::size_t>(k)].emplace_back(glm::ivec3(i, j, k), axis_of_side(side));
            }
    });
    std::vector<Side> sides;
    for (const std::vector<Side>& layer : layers) sides.insert(sides.end(), layer.begin(), layer.end());
    std::vector<Phase> middles(sides.size());
    tbb::parallel_for(std::size_t{0}, sides.size(), [&](std::size_t i) {
        if (i % 256 == 0) cancelled();
        middles[i] = phase_in_middle(sides[i].first, sides[i].second);
    });
    for (std::size_t i = 0; i < sides.size(); ++i) middles_.emplace(key(sides[i].first, sides[i].second), middles[i]);
}

void JoinedSides::find(const Labels& labels, const glm::ivec3& cube) {
    const Corners corners = corners_of(grid_, labels, cube);
    for (int side = 0; side < 6; ++side) {
        if (!take_turns(corners, side)) continue;
        const glm::ivec3 point = cube + offset_of_side(side);
        const auto [place, is_new] = middles_.try_emplace(key(point, axis_of_side(side)));
        if (is_new) place->second = phase_in_middle(point, axis_of_side(side));
    }
}

CubeLabels JoinedSides::labels_of(const Labels& labels, const glm::ivec3& cube) const {
    CubeLabels result{corners_of(grid_, labels, cube), {}};
    for (int side = 0; side < 6; ++side) {
        if (!take_turns(result.corners, side)) continue;
        const Phase a = result.at(sides_of_cube[side][0]), b = result.at(sides_of_cube[side][1]);
        const Phase middle = middles_.at(key(cube + offset_of_side(side), axis_of_side(side)));
        result.joined[static_cast<std::size_t>(side)] = middle == a || middle == b ? middle : std::max(a, b);
    }
    return result;
}

}  // namespace phasetree::meshing
