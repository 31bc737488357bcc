#pragma once

#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// What is known of a cell's field f where it has only one, f < 0 in one phase and f > 0 in the other: nearly linear.
///     |f(p) − (normal·p + offset)| ≤ slack     for all p in the cell
///     |∂f/∂d − normal·d| ≤ spread              for all directions d of unit length
/// Rounding is allowed for. Without bounds (slack infinite) nothing is known but that f is 1-Lipschitz.
struct LinearBound {
    glm::vec3 normal{0};
    float offset = 0;
    float slack = Bounds::infinity;
    float spread = Bounds::infinity;
};

}  // namespace phasetree
