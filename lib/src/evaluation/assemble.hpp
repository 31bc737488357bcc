#pragma once

#include "kernel/kernel.hpp"
#include "program/program_output.hpp"

namespace phasetree::evaluation {

using kernel::OutputSlot, kernel::Routine, kernel::Step;
using program::ProgramOutput;

/// Instructions made ready to run: registers assigned, operations resolved.
struct Assembly {
    std::vector<Step> steps;
    std::vector<std::uint32_t> data;  ///< for each step where its constants are
    std::vector<OutputSlot> outputs;
    std::uint32_t slots = 0;

    Routine routine(const float* constants) const {
        return {steps.data(), data.data(), constants, steps.size(), outputs.data(), outputs.size()};
    }
};

/// A value that is read after the program has run, though it is no output, and where it is then found.
struct KeptValue {
    std::uint32_t value = 0, slot = 0;
};
/// Values whose last use is past give their register to later ones.
Assembly assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                  std::span<KeptValue> kept = {});

}  // namespace phasetree::evaluation
