#include "scene/transform.hpp"

#include <cmath>

#include "parameters/world_limits.hpp"

namespace phasetree::tracer {

Bounds Transform::image(const Bounds& box) const {
    if (box.empty()) return {};
    const glm::dvec3 centre = (glm::dvec3(box.low) + glm::dvec3(box.high)) * 0.5;
    const glm::dvec3 half = (glm::dvec3(box.high) - glm::dvec3(box.low)) * 0.5;
    const glm::dvec3 to = (*this)(centre);
    const glm::dmat3 sizes{glm::abs(matrix[0]), glm::abs(matrix[1]), glm::abs(matrix[2])};
    const glm::dvec3 reach = sizes * half;
    const glm::dvec3 margin = 1e-6 * (glm::abs(to) + reach);  // more than the rounding of floats
    return {glm::vec3(to - reach - margin), glm::vec3(to + reach + margin)};
}

bool Transform::is_usable() const {
    double lengths = 1;
    for (int i = 0; i < 3; ++i) {
        const double length = glm::length(matrix[i]);
        if (!(length > 1e-12) || !(length < 1e12) || !(std::abs(by[i]) <= static_cast<double>(farthest))) return false;
        lengths *= length;
    }
    return std::abs(glm::determinant(matrix)) > 1e-6 * lengths;
}

}  // namespace phasetree::tracer
