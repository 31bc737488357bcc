#pragma once

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A program of more than two phases, reordered so that the instructions that its first component needs come first. A
/// ray in the first component's phase evaluates only these, until that component says that the ray may leave the phase.
struct FirstComponentFirst {
    WorkingProgram program;
    std::uint32_t prefix = 0;                     ///< the number of those instructions, without the input
    std::span<const std::uint32_t> renumbered{};  ///< for each old index the new one; empty if all are unchanged
};

/// The program is allocated in `results`, `renumbered` in `scratch`.
FirstComponentFirst first_component_first(const WorkingProgram&, const Arenas&);

}  // namespace phasetree::rewriting
