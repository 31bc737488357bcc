#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "phasetree/math/affine_map.hpp"
#include "program/program_output.hpp"

namespace phasetree::rewriting {

using program::ProgramOutput;

/// Rewrites programs with fewer, larger instructions (instruction fusion; program/fused.hpp defines them). Affine maps
/// of space are composed with each other and with the primitive that follows them. A scale and an offset are merged
/// into the primitive that precedes them. This pays off because a small instruction spends most of its time on dispatch
/// and on moving its operands through memory.
///
/// Instructions are fused only if every value stays the same to the last bit, except for the sign of a zero, because a
/// cell must give the same labels as the whole object.
class Fuser {
  public:
    /// Appends the constants of fused instructions to `constants`, without duplicates.
    explicit Fuser(std::vector<float>& constants) : constants_(constants) {}

    struct Fused {
        std::vector<Instruction> code;
        std::vector<std::uint32_t> renumbered;  ///< the new index of each value that still exists
        std::uint32_t prefix = 0;               ///< the number of instructions that the prefix has become
    };
    /// Fuses a program whose first `prefix` instructions must stay first. The values in `kept`, like the outputs,
    /// remain separate values. The result is valid until the next call.
    const Fused& operator()(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                            std::span<const std::uint32_t> kept, std::uint32_t prefix);

    /// The index of these floats among the constants. Appends them if they are not there yet.
    std::uint32_t intern(const void* floats, std::size_t count);

  private:
    /// A point that is an affine map of the point `base`, composed of this many maps; if `maps` is 0, it is not.
    struct AffineChain {
        std::uint32_t base = 0;
        int maps = 0;
        AffineMap map{};
    };
    /// A number equal to scale · (the value of the instruction `primitive`) + offset; if `primitive` is 0, it is not.
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
    std::vector<std::uint32_t> uses_;  ///< for each value: the number of instructions and outputs that use it
    std::vector<char> is_needed_;
    Fused fused_;
};

}  // namespace phasetree::rewriting
