#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// A program's instructions while it is recorded. An instruction that already exists is not written again
/// (hash-consing), so the program has no duplicates.
class InstructionList {
  public:
    /// The program must be empty; the input point becomes its value 0. `limit` is the maximum number of instructions.
    InstructionList(Program& program, std::size_t limit);

    /// The index of the value that an instruction computes. `lipschitz` bounds its slope. Throws ModelError if the
    /// program exceeds the limit of instructions or constants.
    std::uint32_t emit(Op op, std::uint32_t a, std::uint32_t b, std::span<const float> constants, float lipschitz);

    /// Counts steps of work. Throws ModelError if there are too many, or PreparationCancelled. Subtrees whose
    /// instructions already exist add nothing to the program, but still take time.
    void work(std::size_t steps);

    float lipschitz(std::uint32_t value) const { return program_.lipschitz[value]; }
    /// Replaces a value's bound by a smaller one.
    void limit_lipschitz(std::uint32_t value, float bound);
    const Instruction& operator[](std::uint32_t value) const { return program_.instructions[value]; }

  private:
    bool is_same(std::uint32_t value, Op op, std::uint32_t a, std::uint32_t b, std::span<const float> constants) const;

    /// The limit of work, in steps per instruction of a program of the maximum size.
    static constexpr std::size_t most_work_for_one = 16;
    static constexpr std::size_t most_constants = std::size_t{1} << 28;

    Program& program_;
    std::size_t limit_, work_ = 0;
    /// Values by the hash of their instruction. On a collision, a value is stored under the next free number.
    std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

}  // namespace phasetree::program
