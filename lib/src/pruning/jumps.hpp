#pragma once

#include "pruning/prune.hpp"

/// Folds of space jump, which a program records as a slope of FoldMap::jump; where they do not, that goes.
namespace phasetree::pruning {

/// Whether anything in it has a slope that only a jump can have.
bool may_jump(const WorkingProgram&);

/// Slopes within a ball about a point with these values: of the program, but for folds that do not jump there.
std::span<const float> slopes_in_ball(const WorkingProgram&, std::span<const float> constants,
                                      const ValuesAtPoint& centre, float radius, float rounding, Arena& scratch);

/// The smallest period of what is folded in a program and still jumps, infinity if nothing does: larger cells cannot be
/// pruned of it.
float finest_jump(const WorkingProgram&, std::span<const float> constants);

}  // namespace phasetree::pruning
