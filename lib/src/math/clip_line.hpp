#pragma once

#include <span>

#include "phasetree/math/convex_polyhedron.hpp"

namespace phasetree {

/// Clips the range [near, far] of the line origin + t·direction to the intersection of all half-spaces, each moved
/// outwards by a distance. If nothing is left, far < near afterwards.
inline void clip_line(std::span<const HalfSpace> half_spaces, const glm::dvec3& origin, const glm::dvec3& direction,
                      double& near, double& far, double outward = 0) {
    for (const HalfSpace& half : half_spaces) {
        const double away = half.distance(origin) - outward, slope = glm::dot(half.normal, direction);
        if (slope > 0)
            far = std::min(far, -away / slope);
        else if (slope < 0)
            near = std::max(near, -away / slope);
        else if (away > 0)
            far = near - 1;
        if (far < near) return;
    }
}

}  // namespace phasetree
