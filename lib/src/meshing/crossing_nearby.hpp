#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "meshing/label_grid.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::meshing {

/// Finds the nearest interface on the line through a point along an axis. Returns its distance from the point, in
/// cubes, if there is one between `low` and `high`.
inline std::optional<double> crossing_nearby(const Grid& grid, const LineTracer& lines, const glm::dvec3& place,
                                             int axis, double low, double high) {
    const FlushSubnormals flush;
    glm::dvec3 start = place;
    start[axis] = grid.low[axis];
    glm::vec3 direction(0);
    direction[axis] = 1;
    const double length = grid.spacing * (grid.points[axis] - 1);
    std::vector<CrossingOnLine> crossings;
    lines(glm::vec3(start), direction, static_cast<float>(length), crossings);
    std::optional<double> nearest;
    for (const CrossingOnLine& c : crossings) {
        const double at = (start[axis] + static_cast<double>(c.t) - place[axis]) / grid.spacing;
        if (at > low && at < high && !(nearest && std::abs(at) >= std::abs(*nearest))) nearest = at;
    }
    return nearest;
}

}  // namespace phasetree::meshing
