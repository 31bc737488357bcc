#pragma once

#include "pruning/prune.hpp"

/// Folds of space (endless copies) make fields that jump. A program records this by multiplying the Lipschitz bounds of
/// a fold and everything that follows it by FoldMap::jump. In a region where a fold does not jump, the factor can be
/// removed, which makes pruning possible.
namespace phasetree::pruning {

/// Whether a value of the program has a Lipschitz bound so large that only a jump explains it.
bool may_jump(const WorkingProgram&);

/// The Lipschitz bounds of all values in a ball: those of the program, except that folds that do not jump in the ball
/// count as continuous. `centre` holds the values at its centre.
std::span<const float> slopes_in_ball(const WorkingProgram&, const ValuesAtPoint& centre, float radius,
                                      const ProgramContext&, Arena&);

/// The smallest period of those folds of a program that may still jump; infinity if there are none. It is measured in
/// the space of the folded points, which is the object's space unless another map precedes the fold. In boxes larger
/// than its period, nothing of such a fold can be pruned.
float finest_jump(const WorkingProgram&, std::span<const float> constants);

}  // namespace phasetree::pruning
