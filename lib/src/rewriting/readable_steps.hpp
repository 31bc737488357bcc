#pragma once

#include "kernel/kernel.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

using kernel::Routine, kernel::Step;

/// Assigns separate registers to every value, so that all values can be read after the program has run: one register
/// per number, three per point. Returns the number of registers.
std::uint32_t assign_slots(const WorkingProgram&, std::span<std::uint32_t> slot);

/// The steps of a working program, with registers from assign_slots(). All memory is in an arena.
struct ReadableSteps {
    std::span<const Step> steps;
    std::span<const std::uint32_t> data;  ///< for each step the index of its first constant
    std::span<const std::uint32_t> slot;  ///< for each instruction the first register of its value
    std::uint32_t slots = 0;              ///< the number of registers

    Routine routine(const float* constants) const {
        return {steps.data(), data.data(), constants, steps.size(), nullptr, 0};
    }
};

ReadableSteps readable_steps(const WorkingProgram&, Arena&);

}  // namespace phasetree::rewriting
