#pragma once

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A program of more than two phases whose instructions are in another order: those that its first component needs come
/// first. A ray in the first component's phase evaluates only these until that component says that it may leave.
struct FirstComponentFirst {
    WorkingProgram program;
    std::uint32_t leading = 0;                    ///< how many instructions those are, the input not counted
    std::span<const std::uint32_t> renumbered{};  ///< for each old number the new one; empty if all are the same
};

/// The program is in `results`, `renumbered` in `scratch`.
FirstComponentFirst first_component_first(const WorkingProgram&, const Arenas&);

}  // namespace phasetree::rewriting
