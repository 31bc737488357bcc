#pragma once

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

using kernel::Routine, kernel::Step;
using program::gives_point, program::operands;

/// A register of its own for every value, so that all can be read afterwards; a point takes three. Returns how many.
inline std::uint32_t give_slots(const WorkingProgram& program, std::span<std::uint32_t> slot) {
    std::uint32_t slots = 0;
    for (std::size_t i = 0; i < program.code.size(); ++i) {
        slot[i] = slots;
        slots += gives_point(program.code[i].op) ? 3 : 1;
    }
    return slots;
}

/// A working program's steps, whose values can all be read afterwards.
struct ReadableSteps {
    std::span<const Step> steps;
    std::span<const std::uint32_t> data;  ///< for each step where its constants are
    std::span<const std::uint32_t> slot;  ///< of each instruction's value
    std::uint32_t slots = 0;

    Routine routine(const float* constants) const {
        return {steps.data(), data.data(), constants, steps.size(), nullptr, 0};
    }
};

inline ReadableSteps readable_steps(const WorkingProgram& program, Arena& scratch) {
    const std::size_t size = program.code.size();
    const std::span<std::uint32_t> slot = scratch.take<std::uint32_t>(size);
    const std::span<Step> steps = scratch.take<Step>(size);
    const std::span<std::uint32_t> data = scratch.take<std::uint32_t>(size);
    const std::uint32_t slots = give_slots(program, slot);
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const Instruction& in = program.code[i];
        if (operands(in.op) == 0) continue;
        steps[count] = {static_cast<std::uint32_t>(in.op), slot[i], slot[in.a], slot[in.b]};
        data[count++] = in.data;
    }
    return {steps.first(count), data.first(count), slot, slots};
}

}  // namespace phasetree::rewriting
