#pragma once

#include <array>

#include "phasetree/math/enclosure/range.hpp"

namespace phasetree {

/// What a field does in a box: proven, but for the rounding of doubles.
struct FieldInBox {
    double value = 0;                  ///< at the box's centre
    std::array<double, 3> gradient{};  ///< there
    std::array<Range, 3> gradients{};  ///< anywhere in the box
    Range curvature{};                 ///< of d²f/dt² along straight lines of unit speed
};

}  // namespace phasetree
