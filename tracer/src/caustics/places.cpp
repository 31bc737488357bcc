#include "caustics/places.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "caustics/chord.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

PhotonPlaces::PhotonPlaces(const BoundingSphere& ball)
    : ball_(ball), choice_(static_cast<std::size_t>(cells_a_side * cells_a_side * cells_a_side)) {
    set_weights(std::vector<double>(choice_.size(), 1.0));
}

bool PhotonPlaces::meets_ball(std::size_t cell) const {
    // In units of cells: from the ball's centre, which is a corner of cells, to the nearest corner of this cell.
    constexpr int middle = cells_a_side / 2;
    const glm::ivec3 at = coordinates(cell) - middle;
    const glm::ivec3 nearest = glm::max(glm::max(at, -1 - at), glm::ivec3(0));
    return nearest.x * nearest.x + nearest.y * nearest.y + nearest.z * nearest.z < middle * middle;
}

void PhotonPlaces::set_weights(std::span<const double> weights) {
    std::vector<double> in_ball(weights.begin(), weights.end());
    for (std::size_t cell = 0; cell < in_ball.size(); ++cell)
        if (!meets_ball(cell)) in_ball[cell] = 0;
    choice_.set_weights(in_ball);
}

glm::ivec3 PhotonPlaces::coordinates(std::size_t cell) const {
    const int i = static_cast<int>(cell);
    return {i % cells_a_side, i / cells_a_side % cells_a_side, i / (cells_a_side * cells_a_side)};
}

glm::vec3 PhotonPlaces::place(std::size_t cell, const glm::vec3& share) const {
    return corner() + (glm::vec3(coordinates(cell)) + share) * cell_side();
}

std::optional<glm::vec3> PhotonPlaces::sample(float u_cell, const glm::vec3& u) const {
    const std::size_t cell = choice_.sample(static_cast<double>(u_cell));
    const glm::vec3 chosen = place(cell, u);
    return glm::distance(chosen, ball_.centre) < ball_.radius ? std::optional(chosen) : std::nullopt;
}

float PhotonPlaces::density_along(const glm::vec3& origin, const glm::vec3& direction, float length) const {
    const std::optional<Chord> within = chord(ball_, origin, direction);
    if (!within) return 0.0f;
    const float end = std::min(within->leaves, length);
    float t = std::max(within->enters, 0.0f);
    if (!(t < end && end < Bounds::infinity)) return 0.0f;
    // Walks from cell to cell, to the next plane between cells along each axis.
    const glm::vec3 in_cells = (origin + t * direction - corner()) / cell_side();
    glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(in_cells)), 0, cells_a_side - 1);
    glm::vec3 next(Bounds::infinity), step(Bounds::infinity);
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) continue;
        step[axis] = cell_side() / std::abs(direction[axis]);
        const float plane = static_cast<float>(cell[axis] + (direction[axis] > 0.0f ? 1 : 0));
        next[axis] = t + std::max((plane - in_cells[axis]) * cell_side() / direction[axis], 0.0f);
    }
    double sum = 0;
    for (;;) {
        const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        const float until = std::min(next[axis], end);
        const int number = cell.x + cells_a_side * (cell.y + cells_a_side * cell.z);
        sum += choice_.probability(static_cast<std::size_t>(number)) * static_cast<double>(until - t);
        if (!(next[axis] < end)) break;
        t = until;
        next[axis] += step[axis];
        cell[axis] += direction[axis] > 0.0f ? 1 : -1;
        if (cell[axis] < 0 || cell[axis] >= cells_a_side) break;
    }
    const auto side = static_cast<double>(cell_side());
    return static_cast<float>(sum / (side * side * side));
}

}  // namespace phasetree::tracer
