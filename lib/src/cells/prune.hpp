#pragma once

#include "program/assemble.hpp"

namespace phasetree {

/// A program in the course of pruning: as Program, but its constants stay those of the whole.
struct WorkingProgram {
    std::vector<Instruction> code;
    std::vector<float> lipschitz;
    std::vector<ProgramOutput> outputs;
};

/// What is left of a program in a ball of the given radius, if an interface may pass through it; nothing otherwise.
/// `value[i]` is the value of instruction i at the ball's centre, `rounding` bounds the error of any value.
///
/// What remains gives the same labels within the ball, and its components' absolute values are still lower bounds of
/// the distance to where the label changes there. See prune.cpp.
std::optional<WorkingProgram> prune(const WorkingProgram&, std::span<const float> constants,
                                    std::span<const float> value, float radius, float rounding);

/// The smallest period of what is folded in a program and still jumps, infinity if nothing does: larger cells cannot be
/// pruned of it.
float finest_jump(const WorkingProgram&, std::span<const float> constants);

}  // namespace phasetree
