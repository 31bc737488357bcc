#pragma once

#include "kernel/kernel.hpp"
#include "program/program_output.hpp"

namespace phasetree::evaluation {

using kernel::OutputSlot, kernel::Routine, kernel::Step;
using program::ProgramOutput;

/// Instructions that are ready to run: each value has a slot among the registers.
struct Assembly {
    std::vector<Step> steps;
    std::vector<std::uint32_t> data;  ///< for each step, the index of its first constant
    std::vector<OutputSlot> outputs;
    std::uint32_t slots = 0;  ///< the number of slots that the registers need

    /// The routine. It refers to this assembly and to the constants.
    Routine routine(const float* constants) const {
        return {steps.data(), data.data(), constants, steps.size(), outputs.data(), outputs.size()};
    }
};

/// A value that is not an output but is read after the program has run, and the slot that then holds it.
struct KeptValue {
    std::uint32_t value = 0, slot = 0;
};
/// Assigns slots to the values of a program. After its last use, a value's slot is reused for later values.
Assembly assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                  std::span<KeptValue> kept = {});

}  // namespace phasetree::evaluation
