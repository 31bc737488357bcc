#pragma once

#include <optional>

#include "bounding/value_ranges.hpp"
#include "evaluation/values_at_point.hpp"
#include "rewriting/program_context.hpp"
#include "rewriting/specialise.hpp"

/// Pruning deletes what cannot matter in a region of space from a program, in one backward sweep over its instructions
/// (backward_sweep.hpp) with rules for each operation (operation_rules.hpp). There are two kinds of it.
///
/// *By value* (Barbier et al. 2025): of min(a, b) only a is left if a < b is proven for the whole region, and likewise
/// of maxima, and of smooth minima if a is below b by their radius. In a ball that follows from b − a at the centre and
/// the Lipschitz bounds of both; in a box, where gradients are known, from the enclosure of b − a.
///
/// *By the required interval*: of an output only the sign matters, and the sign of max(a, b) − τ is that of b − τ if a
/// stays below τ. Negations, offsets and scalings only move the threshold τ. Of a in min(a, b) nothing matters above
/// the largest value of b, for there the minimum is b. So each value is required only in an interval, and outside of
/// it only on which side it lies (required_interval.hpp). That reaches down a long chain of minima to links that are
/// far from the region, though each of them is too near to the next to be told from it by value.
///
/// What replaces a value is equal to it within its required interval, and outside on the same side of it. Both operands
/// of min(a, b) may be replaced at once, a by a′ and b by b′, which are also equal to them at the interval's ends. Let
/// the minimum be required in [l, u], and A and B be the largest values of a and b in the region. Then a is required in
/// [l, min(u, B)] and b in [l, min(u, A)]. Where a ≤ b (and likewise where b ≤ a),
///     l ≤ a ≤ u   a′ = a, for a ≤ b ≤ B;  b′ = b, or both are above min(u, A) ≥ a   so min(a′, b′) = a
///     a > u       a′ > u;                 b′ > u, for b ≥ a > u                     so min(a′, b′) > u
///     a < l       a′ < l                                                            so min(a′, b′) < l
/// A replacement has the same sign relative to each threshold and is Lipschitz itself, so its distance from the
/// threshold is still a lower bound of the distance to where the sign changes.
///
/// *What replaces a value is no steeper than the value's recorded bound* (WorkingProgram::lipschitz), so the components
/// of a pruned program are 1-Lipschitz in the region. The proof is by induction over the instructions, from the first
/// to the last; operations are those of program.hpp.
///   - An instruction that is kept has the bound that follows from those of its operands, in all operations but three.
///     `corner` is no steeper than the steeper operand because these vary along orthogonal directions; what replaces an
///     operand is made of parts of it, so it varies along the same directions. `guarded` is as steep as its first
///     operand, which is required everywhere and hence is not changed. A node that proves a bound of its
///     own (`one_lipschitz` in tree/domain.hpp), as a blob does for its sum of `falloff`s, has less than the sum of
///     theirs; each falloff is required as far as it is not zero, so none of them is changed.
///   - An operand that replaces a minimum, a maximum, a smooth minimum or a corner is no steeper than the steeper
///     operand, which is the instruction's bound; nor is one that replaces a sum of which the other is zero, whose
///     bound is that of both together.
///   - The maximum that takes the place of `guarded` gets the bound of its steeper operand.
namespace phasetree::pruning {

using bounding::ValueRanges;
using evaluation::ValuesAtPoint;
using rewriting::Arena, rewriting::Arenas, rewriting::ProgramContext, rewriting::RequiredOfLocal,
    rewriting::WorkingProgram;

/// The range of every value in a ball, by the values at its centre and Lipschitz bounds: |v(p) − v(centre)| ≤ slope ·
/// radius. Ranges are computed when they are asked for.
struct RangesInBall {
    ValuesAtPoint centre;
    std::span<const float> slope;
    float radius, value_error;  ///< ProgramContext::value_error

    float low(std::uint32_t i) const { return centre[i] - slack(i); }
    float high(std::uint32_t i) const { return centre[i] + slack(i); }
    bool is_above(std::uint32_t a, std::uint32_t b, float least) const { return low(a) > high(b) + least; }

  private:
    float slack(std::uint32_t i) const { return slope[i] * radius + value_error; }
};

/// The program that is left in a region where the values of a program have these ranges. Nothing if no ray can meet an
/// interface there: that needs two phases, one of which is not opaque. The result is in `results`; or it is the program
/// itself, if that was pruned before and all of it is left.
///
/// In the region the result gives the same labels, and the absolute values of its components are still lower bounds of
/// the distance to where the label changes.
std::optional<WorkingProgram> prune(const WorkingProgram&, const ValueRanges&, const ProgramContext&, const Arenas&);
std::optional<WorkingProgram> prune(const WorkingProgram&, const RangesInBall&, const ProgramContext&, const Arenas&);
/// The same, which also tells how far up the values of local primitives are required. A primitive whose constants
/// several instructions have is left out, because smaller boxes do not find its specialisation again.
std::optional<WorkingProgram> prune(const WorkingProgram&, const RangesInBall&, const ProgramContext&, const Arenas&,
                                    std::span<const RequiredOfLocal>& required);

/// The program without the operations that enlarge distances far from the surface (Op::far_bound), which do not change
/// any sign. Nothing if it has none, or if no interface is left.
std::optional<WorkingProgram> without_far_bounds(const WorkingProgram&, const ProgramContext&, const Arenas&);

}  // namespace phasetree::pruning
