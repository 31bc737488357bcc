#pragma once

#include "cells/linear_bound.hpp"
#include "cells/prune.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree {

struct Enclosed {
    bool is_free = false;  ///< no interface passes through the box that a ray can meet
    LinearBound bound;
    Curvature curvature;
    Bounds box;          ///< around the interface in the box
    ValueRanges ranges;  ///< of every value in the box
};

/// Longer programs are not worth the time that it takes to enclose them.
inline constexpr std::size_t longest_enclosed = 64;

/// Encloses a program's values in a box: interval arithmetic with gradients, which sees what a Lipschitz bound and a
/// ball cannot. `rounding` bounds the error of a value; for `opaque` see prune(). Nothing for a program that is too
/// long, or that folds space.
std::optional<Enclosed> enclose(const WorkingProgram&, std::span<const float> constants, PhaseSet opaque,
                                const Bounds& box, float rounding, Arena& scratch);

}  // namespace phasetree
