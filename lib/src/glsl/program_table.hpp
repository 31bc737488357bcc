#pragma once

#include <map>
#include <string>
#include <vector>

#include "glsl/functions.hpp"
#include "glsl/pruned_grid.hpp"

/// Represents programs as numbers that a shader interprets, instead of as text. Shader compilers take minutes for
/// thousands of calls, of which a box of a grid needs only a few.
namespace phasetree::glsl {

/// Programs that a shader reads from its numbers, four at a time. Each begins with the number of its steps and the
/// number of its outputs, followed by the steps and the outputs.
class ProgramTable {
  public:
    /// All programs use the constants of `whole`.
    ProgramTable(const Program& whole, Functions& functions);

    /// Adds the functions that the program needs. Returns the program's index.
    std::size_t add(const BoxProgram&);
    /// Appends all programs to some numbers; the functions must have offsets. Returns the start of each program, in
    /// units of four numbers.
    std::vector<std::size_t> append_to(std::vector<float>& numbers) const;

    /// The number of slots required by the longest program.
    std::uint32_t slots() const { return slots_; }
    /// The text of pt_run(), which runs a program for a point, or with gradients that of pt_d_run().
    std::string text(bool with_gradients) const;

  private:
    struct Step {
        std::uint32_t instruction, to, a, b;
    };
    struct Entry {
        std::vector<Step> steps;
        std::vector<std::array<float, 4>> outputs;
    };
    std::uint32_t instruction_at(const Instruction&);

    const Program& whole_;
    Functions& functions_;
    std::vector<std::uint32_t> ends_;  // for the index of an instruction's first constant: the end of its constants;
                                       // otherwise 0
    std::map<std::pair<Op, std::uint32_t>, std::uint32_t> known_;
    std::vector<Entry> entries_;
    std::uint32_t slots_ = 3;
};

}  // namespace phasetree::glsl
