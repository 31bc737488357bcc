#pragma once

#include <span>

#include "program/op_traits.hpp"
#include "program/program_output.hpp"
#include "rewriting/arena.hpp"

namespace phasetree::rewriting {

using program::ProgramOutput;

/// A program derived from an object's program for a part of space. It differs from Program in two ways: its constants
/// remain those of the whole program (ProgramContext::constants), and an unused operand is 0, the input. Copies are
/// cheap and refer to the same arena.
struct WorkingProgram {
    std::span<const Instruction> code;  ///< code[0] is the input point
    std::span<const float> lipschitz;   ///< a Lipschitz bound of each value
    std::span<const ProgramOutput> outputs;
};

}  // namespace phasetree::rewriting
