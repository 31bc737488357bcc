#pragma once

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// The instructions of a program that some of its outputs need (liveness analysis of straight-line code, in a single
/// backward pass from the outputs).
class LiveSet {
  public:
    /// Keeps references to the program and the outputs. Its own memory is in `scratch`.
    LiveSet(const WorkingProgram&, std::span<const ProgramOutput>, Arena& scratch);

    /// The number of live instructions, without the input.
    std::size_t size() const { return size_; }
    bool has(std::size_t instruction) const { return instruction == 0 || is_live_[instruction]; }

    /// The live instructions, renumbered, as a program with these outputs.
    WorkingProgram program(const Arenas&) const;

  private:
    const WorkingProgram& program_;
    std::span<const ProgramOutput> outputs_;
    std::span<char> is_live_;
    std::size_t size_ = 0;
};

}  // namespace phasetree::rewriting
