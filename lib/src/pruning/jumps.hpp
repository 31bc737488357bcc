#pragma once

#include "pruning/prune.hpp"

/// Folds of space (endless copies) make fields that jump. A program records that by multiplying the Lipschitz bounds of
/// a fold and of all that follows it by FoldMap::jump. In a region in which a fold does not jump, the factor can be
/// taken away again, and then pruning is possible.
namespace phasetree::pruning {

/// Whether a value of the program has a Lipschitz bound that only a jump explains.
bool may_jump(const WorkingProgram&);

/// The Lipschitz bounds of all values in a ball: those of the program, except that folds which do not jump in the ball
/// count as continuous. `centre` holds the values at its centre.
std::span<const float> slopes_in_ball(const WorkingProgram&, const ValuesAtPoint& centre, float radius,
                                      const ProgramContext&, Arena&);

/// The smallest period of the folds of a program that still may jump; infinity if there are none. It is in the space of
/// the points that are folded, which is the object's space unless another map is applied before the fold. Nothing of
/// such a fold can be pruned in boxes larger than its period.
float finest_jump(const WorkingProgram&, std::span<const float> constants);

}  // namespace phasetree::pruning
