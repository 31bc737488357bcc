#pragma once

#include "cells/prune.hpp"

namespace phasetree {

/// A working program's steps but for those to leave out, with a register of its own for every value so that all can be
/// read afterwards.
struct Steps {
    std::span<const Step> steps;
    std::span<const std::uint32_t> data;  ///< for each step where its constants are
    std::span<const std::uint32_t> slot;  ///< of each instruction's value; a point takes three
    std::uint32_t slots = 0;

    Routine routine(const float* constants) const {
        return {steps.data(), data.data(), constants, steps.size(), nullptr, 0};
    }
};

template <class LeftOut>
Steps keep_all(const WorkingProgram& program, Arena& scratch, LeftOut&& is_left_out) {
    const std::span<std::uint32_t> slot = scratch.take<std::uint32_t>(program.code.size());
    const std::span<Step> steps = scratch.take<Step>(program.code.size());
    const std::span<std::uint32_t> data = scratch.take<std::uint32_t>(program.code.size());
    std::uint32_t slots = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < program.code.size(); ++i) {
        const Instruction& in = program.code[i];
        slot[i] = slots;
        slots += gives_point(in.op) ? 3 : 1;
        const int n = operands(in.op);
        if (n == 0 || is_left_out(i)) continue;
        steps[count] = {static_cast<std::uint32_t>(in.op), slot[i], slot[in.a], n > 1 ? slot[in.b] : 0};
        data[count++] = in.data;
    }
    return {steps.first(count), data.first(count), slot, slots};
}
inline Steps keep_all(const WorkingProgram& program, Arena& scratch) {
    return keep_all(program, scratch, [](std::size_t) { return false; });
}

}  // namespace phasetree
