#include "caustics/points_in_ball.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "caustics/chord.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree::tracer {

PointsInBall::PointsInBall(const BoundingSphere& ball)
    : ball_(ball), choice_(static_cast<std::size_t>(bins_per_side * bins_per_side * bins_per_side)) {
    set_weights(std::vector<double>(choice_.size(), 1.0));
}

bool PointsInBall::meets_ball(std::size_t bin) const {
    // In units of bins: from the ball's centre, which is a corner of bins, to the nearest corner of this bin.
    constexpr int middle = bins_per_side / 2;
    const glm::ivec3 at = coordinates(bin) - middle;
    const glm::ivec3 nearest = glm::max(glm::max(at, -1 - at), glm::ivec3(0));
    return nearest.x * nearest.x + nearest.y * nearest.y + nearest.z * nearest.z < middle * middle;
}

void PointsInBall::set_weights(std::span<const double> weights) {
    std::vector<double> in_ball(weights.begin(), weights.end());
    for (std::size_t bin = 0; bin < in_ball.size(); ++bin)
        if (!meets_ball(bin)) in_ball[bin] = 0;
    choice_.set_weights(in_ball);
}

glm::ivec3 PointsInBall::coordinates(std::size_t bin) const {
    const int i = static_cast<int>(bin);
    return {i % bins_per_side, i / bins_per_side % bins_per_side, i / (bins_per_side * bins_per_side)};
}

glm::vec3 PointsInBall::point(std::size_t bin, const glm::vec3& u) const {
    return corner() + (glm::vec3(coordinates(bin)) + u) * bin_side();
}

std::optional<glm::vec3> PointsInBall::sample(float u_bin, const glm::vec3& u) const {
    const std::size_t bin = choice_.sample(static_cast<double>(u_bin));
    const glm::vec3 chosen = point(bin, u);
    return glm::distance(chosen, ball_.centre) < ball_.radius ? std::optional(chosen) : std::nullopt;
}

float PointsInBall::density_along(const glm::vec3& origin, const glm::vec3& direction, float length) const {
    const std::optional<Chord> within = chord(ball_, origin, direction);
    if (!within) return 0.0f;
    const float end = std::min(within->leaves, length);
    float t = std::max(within->enters, 0.0f);
    if (!(t < end && end < Bounds::infinity)) return 0.0f;
    // Walks from bin to bin, to the next plane between bins along each axis.
    const glm::vec3 in_bins = (origin + t * direction - corner()) / bin_side();
    glm::ivec3 bin = glm::clamp(glm::ivec3(glm::floor(in_bins)), 0, bins_per_side - 1);
    glm::vec3 next(Bounds::infinity), step(Bounds::infinity);
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) continue;
        step[axis] = bin_side() / std::abs(direction[axis]);
        const float plane = static_cast<float>(bin[axis] + (direction[axis] > 0.0f ? 1 : 0));
        next[axis] = t + std::max((plane - in_bins[axis]) * bin_side() / direction[axis], 0.0f);
    }
    double sum = 0;
    for (;;) {
        const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        const float until = std::min(next[axis], end);
        const int number = bin.x + bins_per_side * (bin.y + bins_per_side * bin.z);
        sum += choice_.probability(static_cast<std::size_t>(number)) * static_cast<double>(until - t);
        if (!(next[axis] < end)) break;
        t = until;
        next[axis] += step[axis];
        bin[axis] += direction[axis] > 0.0f ? 1 : -1;
        if (bin[axis] < 0 || bin[axis] >= bins_per_side) break;
    }
    const auto side = static_cast<double>(bin_side());
    return static_cast<float>(sum / (side * side * side));
}

}  // namespace phasetree::tracer
