#pragma once

#include <array>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// What is known of a cell's field f: nearly linear. Where two phases meet, f < 0 in one and f > 0 in the other; where
/// more do, f is the first component, but for its sign, and concerns rays in its phase.
///     |f(p) − (normal·p + offset)| ≤ slack     for all p in the cell
///     |∂f/∂d − normal·d| ≤ spread              for all directions d of unit length
/// Rounding is allowed for. Without bounds (slack infinite) nothing is known but that f is 1-Lipschitz.
struct LinearBound {
    glm::vec3 normal{0};
    float offset = 0;
    float slack = Bounds::infinity;
    float spread = Bounds::infinity;
};

/// How much s, the distance that the label is the same within, curves upward in a cell: d²s/dt² along any straight line
/// of unit speed, at most. Seams count where the slope rises. Where more than one component is left there are two
/// choices of s: see Routine::is_by_own.
struct Curvature {
    static constexpr float unknown = Bounds::infinity;

    /// In the phase of the first output, where it is by its own component if more than two phases meet; and in the
    /// others. Where those are opaque, so that no ray is in them, s is the first component there, too.
    std::array<float, 2> bound{unknown, unknown};
    bool is_by_own = false;    ///< in the others
    bool is_by_first = false;  ///< the first component tells s on both sides
};

}  // namespace phasetree
