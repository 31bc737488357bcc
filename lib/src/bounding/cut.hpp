#pragma once

#include "phasetree/math/bounds.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::enclosure {
struct Enclosure;
}

namespace phasetree::bounding {

using enclosure::Enclosure;
using rewriting::Arena, rewriting::WorkingProgram;

/// What floats lose where a box is cut. `rounding` bounds the error of a value.
float cut_margin(const Bounds& box, float rounding);

/// The part of a box that a value can be zero in, from the enclosures of a program's values in `all` around it: by the
/// linear bounds of what minima and maxima are made of, and by set algebra, as
///     {max(a, b) = 0}  ⊂  {a = 0, b ≤ 0} ∪ {b = 0, a ≤ 0}.
/// Where an edge passes through a box, its two sides' bounds hold, though the maximum has none. Empty if the value is
/// zero nowhere.
Bounds cut_to_zero(std::uint32_t value, const Bounds& box, const Bounds& all, const WorkingProgram&,
                   std::span<const float> constants, const Enclosure* registers, std::span<const std::uint32_t> slot,
                   float rounding, Arena& scratch);

}  // namespace phasetree::bounding
