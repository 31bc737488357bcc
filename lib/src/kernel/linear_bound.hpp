#pragma once

#include <array>

#include "phasetree/math/bounds.hpp"

namespace phasetree::kernel {

/// A linear approximation of a cell's field f, with error bounds. Where two phases meet, f is negative in one and
/// positive in the other. Where more phases meet, f is the value of the first component, possibly negated, and the
/// bound is used only for rays in the phase of that component.
///     |f(p) − (normal·p + offset)| ≤ slack     for all p in the cell
///     |∂f/∂d − normal·d| ≤ spread              for all directions d of unit length
/// The bounds include rounding errors. If the slack is infinite, f is only known to be 1-Lipschitz.
struct LinearBound {
    glm::vec3 normal{0};
    float offset = 0;
    float slack = Bounds::infinity;
    float spread = Bounds::infinity;
};

/// An upper bound on d²s/dt² along any straight line of unit speed in a cell, where s is the kernel's lower bound on
/// the distance to a change of label. No such bound exists where the slope jumps upwards. A cell with more than one
/// component can use either of two definitions of s: see Routine::uses_own_component.
struct Curvature {
    static constexpr float unknown = Bounds::infinity;

    /// The bounds of s for a ray in the phase of the first output, and for one in another phase. Each holds in the
    /// whole cell, on both sides of the interface. For a ray in the first phase, s is minus the first component if more
    /// than two phases meet. If all other phases are opaque, so that no ray is in them, s is the first component there.
    std::array<float, 2> bound{unknown, unknown};
    bool uses_own_component = false;       ///< Routine::uses_own_component in the other phases
    bool first_component_decides = false;  ///< whether the first component gives s in all phases
};

}  // namespace phasetree::kernel
