#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// A program's instructions while they are recorded. An instruction that is there already is not written again
/// (hash-consing), so the program has no duplicates.
class InstructionList {
  public:
    /// The program must be empty; it gets the input point as value 0. `limit` is the largest number of instructions.
    InstructionList(Program& program, std::size_t limit);

    /// The index of the value that an instruction computes. `lipschitz` bounds its slope. Throws ModelError if the
    /// program gets too many instructions or constants.
    std::uint32_t emit(Op op, std::uint32_t a, std::uint32_t b, std::span<const float> constants, float lipschitz);

    /// Counts steps of work. Throws ModelError if there are too many: subtrees whose instructions are there already add
    /// nothing to the program, and take time all the same.
    void work(std::size_t steps);

    float lipschitz(std::uint32_t value) const { return program_.lipschitz[value]; }
    /// Replaces a value's bound by a smaller one.
    void limit_lipschitz(std::uint32_t value, float bound);
    const Instruction& operator[](std::uint32_t value) const { return program_.instructions[value]; }

  private:
    bool is_same(std::uint32_t value, Op op, std::uint32_t a, std::uint32_t b, std::span<const float> constants) const;

    /// A program of the largest size takes at most this many steps of work for each instruction.
    static constexpr std::size_t most_work_for_one = 16;
    static constexpr std::size_t most_constants = std::size_t{1} << 28;

    Program& program_;
    std::size_t limit_, work_ = 0;
    /// Values by the hash of their instruction; of several with one hash, each has the next number that is free.
    std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

}  // namespace phasetree::program
