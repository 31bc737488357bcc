#pragma once

#include "bounding/enclosed_program.hpp"

namespace phasetree::bounding {

/// A bound of what rounding moves a plane by when a box is cut, as a distance. `value_error` is that of ProgramContext.
float cut_margin(const Bounds& box, float value_error);

/// The smallest box found around the part of `box` in which a value of an enclosed program can be zero; empty if it can
/// be zero nowhere. `box` lies within the box of the enclosures.
///
/// Each value that is nearly linear leaves only a slab of the box. At an edge, where two fields a and b meet, their
/// maximum is not nearly linear, but both operands are, and set algebra combines the boxes that they leave:
///     {max(a, b) = 0}  ⊂  {a = 0, b ≤ 0} ∪ {b = 0, a ≤ 0}.
Bounds cut_to_zero(std::uint32_t value, const Bounds& box, const EnclosedProgram&, Arena& scratch);

}  // namespace phasetree::bounding
