#pragma once

#include "enclosure/number.hpp"
#include "phasetree/math/bounds.hpp"
#include "rewriting/program_context.hpp"

namespace phasetree::bounding {

using enclosure::Enclosure;
using rewriting::Arena, rewriting::ProgramContext, rewriting::WorkingProgram;

/// A program and the enclosures of all its values in a box. Copies are cheap, and refer to the arena of the Encloser
/// that made it.
struct EnclosedProgram {
    WorkingProgram program;
    Bounds box;
    const ProgramContext* context = nullptr;
    const Enclosure* registers = nullptr;
    std::span<const std::uint32_t> slot;  ///< for each instruction, the first register of its value

    const Enclosure& operator[](std::uint32_t value) const { return registers[slot[value]]; }
    std::span<const float> constants() const { return context->constants; }
};

}  // namespace phasetree::bounding
