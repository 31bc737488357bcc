#pragma once

#include "phasetree/program/program.hpp"
#include "program/assemble.hpp"

namespace phasetree {

/// A program with its negations moved outward, from operand to result and in the end into the outputs' signs:
///     min(−a, −b) = −max(a, b),  −(a + c) = −c − a,  (−a)·k = −(a·k) …
/// Operators of objects negate a lot (φ₀ = −f, a layer's −a₀ − t); in a cell, where a handful of instructions is left,
/// every third would be a negation. Rounding is symmetric, so the values are the same but for the sign of a zero.
struct OutwardProgram {
    std::vector<Instruction> code;
    std::vector<float> lipschitz;
    std::vector<ProgramOutput> outputs;
};

/// Appends the constants that are new to the program's.
OutwardProgram move_negations_outward(Program&);

}  // namespace phasetree
