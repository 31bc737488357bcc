#pragma once

#include "bounding/enclosed_program.hpp"

namespace phasetree::bounding {

/// An upper bound on the distance by which rounding errors move a plane when a box is cut. `value_error` is that of
/// ProgramContext.
float cut_margin(const Bounds& box, float value_error);

/// The smallest box found around the part of `box` in which a value of an enclosed program can be zero; empty if it can
/// be zero nowhere. `box` lies within the box of the enclosures.
///
/// Each value that is nearly linear confines the zeros to a slab of the box. At an edge, where two fields a and b meet,
/// their maximum is not nearly linear. But both operands are, and set algebra combines their boxes:
///     {max(a, b) = 0}  ⊂  {a = 0, b ≤ 0} ∪ {b = 0, a ≤ 0}.
Bounds cut_to_zero(std::uint32_t value, const Bounds& box, const EnclosedProgram&, Arena& scratch);

}  // namespace phasetree::bounding
