#include "rewriting/readable_steps.hpp"

namespace phasetree::rewriting {

using program::gives_point, program::operands;

std::uint32_t assign_slots(const WorkingProgram& program, std::span<std::uint32_t> slot) {
    std::uint32_t slots = 0;
    for (std::size_t i = 0; i < program.code.size(); ++i) {
        slot[i] = slots;
        slots += gives_point(program.code[i].op) ? 3 : 1;
    }
    return slots;
}

ReadableSteps readable_steps(const WorkingProgram& program, Arena& arena) {
    const std::size_t size = program.code.size();
    const std::span<std::uint32_t> slot = arena.allocate<std::uint32_t>(size);
    const std::span<Step> steps = arena.allocate<Step>(size);
    const std::span<std::uint32_t> data = arena.allocate<std::uint32_t>(size);
    const std::uint32_t slots = assign_slots(program, slot);
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
