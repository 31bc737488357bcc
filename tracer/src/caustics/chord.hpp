// The part of a straight line inside a ball.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "lights/bounding_sphere.hpp"

namespace phasetree::tracer {

/// The distances along a line at which it enters and leaves a ball; negative behind the line's origin.
struct Chord {
    float enters, leaves;
};

/// The direction has unit length. nullopt if the line misses the ball.
inline std::optional<Chord> chord(const BoundingSphere& ball, const glm::vec3& origin, const glm::vec3& direction) {
    const float along = glm::dot(ball.centre - origin, direction);
    const glm::vec3 across = ball.centre - origin - along * direction;
    const float squared_half = ball.radius * ball.radius - glm::dot(across, across);
    if (!(squared_half > 0.0f)) return std::nullopt;
    const float half = std::sqrt(squared_half);
    return Chord{along - half, along + half};
}

}  // namespace phasetree::tracer
