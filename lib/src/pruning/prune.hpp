#pragma once

#include <optional>
#include <span>

#include "bounding/value_ranges.hpp"
#include "evaluation/values_at_point.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::pruning {

using bounding::ValueRanges;
using evaluation::ValuesAtPoint;
using rewriting::Arena, rewriting::WorkingProgram;

/// Bounds of every value in a ball, by values at its centre and Lipschitz bounds; worked out for those that are asked.
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

/// Without what makes distances larger far from the surface, if there is any (Op::far_bound): the signs are the same.
std::optional<WorkingProgram> without_far_bounds(const WorkingProgram&, std::span<const float> constants,
                                                 PhaseSet opaque, Arena& keep, Arena& scratch);

}  // namespace phasetree::pruning
