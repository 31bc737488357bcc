#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "phasetree/math/affine_map.hpp"
#include "program/program_output.hpp"

namespace phasetree::rewriting {

using program::ProgramOutput;

/// Writes programs with fewer, larger instructions (instruction fusion; the instructions are those of
/// program/fused.hpp): affine maps of space are composed with each other and with the primitive that follows them, and
/// a scale and an offset are joined to the primitive that precedes them. This is worth it because most of the time of a
/// small instruction is its dispatch and the traffic of its operands through memory. Instructions are fused only where
/// every value stays the same to the last bit, except for the sign of a zero, because a cell must give the same labels
/// as the whole object.
class Fuser {
  public:
    /// Constants of fused instructions are appended to `constants`, equal ones once.
    explicit Fuser(std::vector<float>& constants) : constants_(constants) {}

    struct Fused {
        std::vector<Instruction> code;
        std::vector<std::uint32_t> renumbered;  ///< the new number of each value that still exists
        std::uint32_t leading = 0;              ///< how many instructions the leading ones have become
    };
    /// Fuses a program whose first `leading` instructions are to stay in front. The values in `kept` stay values of
    /// their own, as the outputs' do. The result is valid until the next call.
    const Fused& operator()(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                            std::span<const std::uint32_t> kept, std::uint32_t leading);

    /// The index of these floats among the constants, to which they are appended unless they are there.
    std::uint32_t intern(const void* floats, std::size_t count);

  private:
    /// A point that is an affine map of the point `base`, composed of this many maps; none if `maps` is 0.
    struct AffineChain {
        std::uint32_t base = 0;
        int maps = 0;
        AffineMap map{};
    };
    /// A number that is scale · (the value of the instruction `primitive`) + offset; none if `primitive` is 0.
    struct ScaledPrimitive {
        std::uint32_t primitive = 0;
        float scale = 1, offset = 0;
    };

    void find_affine_values(std::span<const Instruction> code);
    ScaledPrimitive scaled_primitive(const Instruction&) const;
    Instruction fused(std::span<const Instruction> code, std::uint32_t i);

    std::vector<float>& constants_;
    struct Interned {
        std::uint32_t first, count;
    };
    std::unordered_multimap<std::uint64_t, Interned> interned_;  ///< by the hash of the floats
    std::vector<AffineChain> chains_;
    std::vector<ScaledPrimitive> scaled_;
    std::vector<std::uint32_t> uses_;  ///< of each value, how many instructions and outputs use it
    std::vector<char> is_needed_;
    Fused fused_;
};

}  // namespace phasetree::rewriting
