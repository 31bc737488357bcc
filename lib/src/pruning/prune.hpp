#pragma once

#include <array>
#include <optional>
#include <span>

#include "rewriting/arena.hpp"
#include "evaluation/assemble.hpp"

namespace phasetree {

struct Enclosure;

/// A program in the course of pruning: as Program, but its constants stay those of the whole, and operands that an
/// operation does not take are 0, the input. Its memory is an arena's.
struct WorkingProgram {
    std::span<const Instruction> code;
    std::span<const float> lipschitz;
    std::span<const ProgramOutput> outputs;
};

/// The values of a program's instructions at one point, as a kernel left them: in one lane of their registers.
struct ValuesAtPoint {
    const BatchOfFloats* registers;
    std::span<const std::uint32_t> slot;
    std::size_t lane;

    float operator[](std::size_t instruction) const { return registers[slot[instruction]].lane[lane]; }
};

/// Bounds of every instruction's value in a box, and of its slope there; and the enclosures that they are of, which
/// know differences better.
struct ValueRanges {
    std::span<const float> lows, highs, slope;
    std::span<const Instruction> code;
    const Enclosure* registers;
    std::span<const std::uint32_t> slot;
    std::array<double, 3> half;  ///< the box's half extents
    double margin;               ///< of a value

    float low(std::uint32_t i) const { return lows[i]; }
    float high(std::uint32_t i) const { return highs[i]; }
    /// Whether a − b > least throughout. Minima and maxima are looked into that many deep.
    bool is_above(std::uint32_t a, std::uint32_t b, float least, int depth = 1) const;
};

/// The same in a ball, by values at its centre and Lipschitz bounds; worked out for those that are asked.
struct RangesInBall {
    ValuesAtPoint centre;
    std::span<const float> slope;
    float radius, rounding;  ///< which bounds the error of any value

    float low(std::uint32_t i) const { return centre[i] - slack(i); }
    float high(std::uint32_t i) const { return centre[i] + slack(i); }
    bool is_above(std::uint32_t a, std::uint32_t b, float least) const { return low(a) > high(b) + least; }

  private:
    float slack(std::uint32_t i) const { return slope[i] * radius + rounding; }
};

/// What is left of a program in a region where its values are within these ranges, if an interface may pass through it
/// that a ray can meet, which is in a phase that is not opaque; nothing otherwise. The result is in `keep`, or it is
/// the program itself, if that was pruned before and all of it is left; `scratch` is left as it was.
///
/// What remains gives the same labels in the region, and its components' absolute values are still lower bounds of the
/// distance to where the label changes there. See prune.cpp.
std::optional<WorkingProgram> prune(const WorkingProgram&, std::span<const float> constants, const ValueRanges&,
                                    PhaseSet opaque, Arena& keep, Arena& scratch);
std::optional<WorkingProgram> prune(const WorkingProgram&, std::span<const float> constants, const RangesInBall&,
                                    PhaseSet opaque, Arena& keep, Arena& scratch);

/// Whether an operation makes distances larger far from the surface.
inline bool is_far_bound(Op op) {
    return op == Op::far_bound || op == Op::far_bound_inside;
}
/// Without what makes distances larger far from the surface, if there is any (Op::far_bound): the signs are the same.
std::optional<WorkingProgram> without_far_bounds(const WorkingProgram&, std::span<const float> constants,
                                                 PhaseSet opaque, Arena& keep, Arena& scratch);

}  // namespace phasetree
