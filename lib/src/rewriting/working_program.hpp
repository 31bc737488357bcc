#pragma once

#include <span>

#include "program/op_traits.hpp"
#include "program/program_output.hpp"
#include "rewriting/arena.hpp"

namespace phasetree::rewriting {

using program::ProgramOutput;

/// A program in the course of pruning: as Program, but its constants stay those of the whole, and operands that an
/// operation does not take are 0, the input. Its memory is an arena's.
struct WorkingProgram {
    std::span<const Instruction> code;
    std::span<const float> lipschitz;
    std::span<const ProgramOutput> outputs;
};

}  // namespace phasetree::rewriting
