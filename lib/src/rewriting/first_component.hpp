#pragma once

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A program of more than two phases with what its first component needs before the rest.
struct FirstComponentFirst {
    WorkingProgram program;
    std::uint32_t leading = 0;                    ///< instructions that it needs, the input not counted
    std::span<const std::uint32_t> renumbered{};  ///< where each instruction went, in `scratch`; empty if they stayed
};
FirstComponentFirst first_component_first(const WorkingProgram&, Arena& keep, Arena& scratch);

}  // namespace phasetree::rewriting
