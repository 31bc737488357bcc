#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "phasetree/math/affine_map.hpp"
#include "program/program_output.hpp"

namespace phasetree::rewriting {

using program::ProgramOutput;

/// Writes programs with fewer, larger instructions (program/fused.hpp): maps of space that are affine are composed with
/// each other and with the primitive behind them, and a scale and an offset with the primitive before them. What an
/// instruction costs is mostly the way to it and its operands' way through memory. Only where values stay the same to
/// the last bit, but for the sign of a zero: a cell's labels are the whole object's.
class Fuser {
  public:
    /// New constants are appended to these, equal ones once.
    explicit Fuser(std::vector<float>& constants) : constants_(constants) {}

    struct Fused {
        std::vector<Instruction> code;
        std::vector<std::uint32_t> where;  ///< of each value that is still there
        std::uint32_t leading = 0;         ///< of so many leading instructions
    };
    /// `kept` are values that must stay, besides the outputs'. The result holds until the next call.
    const Fused& operator()(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                            std::span<const std::uint32_t> kept, std::uint32_t leading);

    /// Where these floats are among the constants.
    std::uint32_t constant(const void* floats, std::size_t count);

  private:
    /// An affine map of the value `base`, or nothing affine.
    struct Frame {
        std::uint32_t base = 0;
        int maps = 0;  ///< how many are in it
        AffineMap map{};
    };
    /// scale · a primitive + offset, which is instruction `primitive`, or none.
    struct Group {
        std::uint32_t primitive = 0;
        float scale = 1, offset = 0;
    };

    void follow(std::span<const Instruction> code);
    Instruction fused(std::span<const Instruction> code, std::uint32_t i);

    std::vector<float>& constants_;
    std::unordered_map<std::string, std::uint32_t> known_;
    std::vector<Frame> frames_;
    std::vector<Group> groups_;
    std::vector<std::uint32_t> uses_;
    std::vector<char> is_needed_;
    Fused fused_;
};

}  // namespace phasetree::rewriting
