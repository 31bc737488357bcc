#pragma once

#include <map>
#include <string>
#include <vector>

#include "glsl/functions.hpp"
#include "glsl/pruned_grid.hpp"

/// Programs as numbers that a shader runs, and not as text: compilers of shaders take minutes for thousands of calls,
/// and a box of a grid needs few of them.
namespace phasetree::glsl {

/// Programs that a shader reads from its numbers, four at a time. Each begins with the numbers of its steps and of its
/// outputs; the steps and the outputs follow.
class ProgramTable {
  public:
    /// The constants of all programs are those of `whole`.
    ProgramTable(const Program& whole, Functions& functions);

    /// Adds what the program needs to the functions, and returns the program's number.
    std::size_t add(const BoxProgram&);
    /// Appends all programs to some numbers, once functions have offsets. Returns where each begins, in fours.
    std::vector<std::size_t> append_to(std::vector<float>& numbers) const;

    /// Slots that the longest program needs.
    std::uint32_t slots() const { return slots_; }
    /// pt_run(), which runs a program for a point; with gradients pt_d_run().
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
    std::vector<std::uint32_t> ends_;  // for each constant at which those of an instruction begin, where they end; or 0
    std::map<std::pair<Op, std::uint32_t>, std::uint32_t> known_;
    std::vector<Entry> entries_;
    std::uint32_t slots_ = 3;
};

}  // namespace phasetree::glsl
