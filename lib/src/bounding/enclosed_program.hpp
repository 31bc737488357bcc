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
    Enclosure::Vector half{};             ///< the box's half extents, rounded up

    const Enclosure& operator[](std::uint32_t value) const { return registers[slot[value]]; }
    std::span<const float> constants() const { return context->constants; }
    /// The enclosure of an output's value, without the output's sign. Components are 1-Lipschitz, even in pruned
    /// programs (for the proof, see pruning/prune.hpp). So their gradients are within ±1 even where the enclosures of
    /// the instructions are wider.
    Enclosure of_output(const program::ProgramOutput& o) const {
        Enclosure e = (*this)[o.value];
        for (enclosure::Interval& g : e.gradient) g = {std::max(g.low, -1.0), std::min(g.high, 1.0)};
        e.tighten(half);
        return e;
    }
};

}  // namespace phasetree::bounding
