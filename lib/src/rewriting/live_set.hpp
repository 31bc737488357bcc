#pragma once

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// Only what some outputs reach, of a program that is otherwise unchanged.
class LiveSet {
  public:
    LiveSet(const WorkingProgram& program, std::span<const ProgramOutput> outputs, Arena& scratch)
        : program_(program), outputs_(outputs), is_live_(scratch.take<char>(program.code.size())) {
        std::ranges::fill(is_live_, char{0});
        for (const ProgramOutput& o : outputs) is_live_[o.value] = 1;
        for (std::size_t i = program.code.size(); i-- > 1;) {
            if (!is_live_[i]) continue;
            ++size_;
            is_live_[program.code[i].a] = 1;
            is_live_[program.code[i].b] = 1;
        }
    }
    std::size_t size() const { return size_; }
    bool has(std::size_t i) const { return i == 0 || is_live_[i]; }

    /// It, renumbered.
    WorkingProgram program(Arena& keep, Arena& scratch) const {
        if (size_ + 1 == program_.code.size())
            return {keep.copy(program_.code), keep.copy(program_.lipschitz), keep.copy(outputs_)};
        const std::span<std::uint32_t> renumbered = scratch.take<std::uint32_t>(program_.code.size());
        const std::span<Instruction> code = keep.take<Instruction>(size_ + 1);
        const std::span<float> lipschitz = keep.take<float>(size_ + 1);
        const std::span<ProgramOutput> ends = keep.take<ProgramOutput>(outputs_.size());
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < program_.code.size(); ++i) {
            renumbered[i] = count;
            if (i > 0 && !is_live_[i]) continue;
            const Instruction& in = program_.code[i];
            code[count] = {in.op, renumbered[in.a], renumbered[in.b], in.data};
            lipschitz[count++] = program_.lipschitz[i];
        }
        for (std::size_t k = 0; k < outputs_.size(); ++k)
            ends[k] = {outputs_[k].phase, renumbered[outputs_[k].value], outputs_[k].negate};
        return {code, lipschitz, ends};
    }

  private:
    const WorkingProgram& program_;
    std::span<const ProgramOutput> outputs_;
    std::span<char> is_live_;
    std::size_t size_ = 0;
};

}  // namespace phasetree::rewriting
