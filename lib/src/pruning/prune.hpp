#pragma once

#include <optional>

#include "bounding/value_ranges.hpp"
#include "evaluation/values_at_point.hpp"
#include "rewriting/program_context.hpp"
#include "rewriting/specialise.hpp"

/// Pruning deletes from a program what cannot matter in a region of space. It is a single backward sweep over the
/// instructions (backward_sweep.hpp) with rules for each operation (operation_rules.hpp). It prunes in two ways.
///
/// *By value* (Barbier et al., *Lipschitz Pruning: Hierarchical Simplification of Primitive-Based SDFs*, Eurographics
/// 2025): only a is left of min(a, b) if a < b is proven for the whole region. The same holds for maxima, and for
/// smooth minima if a is below b by their radius. In a ball, the proof follows from b − a at the centre and the
/// Lipschitz bounds of both; in a box, where gradients are known, from the enclosure of b − a.
///
/// *By the required interval*: only the sign of an output matters, and the sign of max(a, b) − τ is that of b − τ if a
/// stays below τ. Negations, offsets and scalings only move the threshold τ. In min(a, b), values of a above the
/// largest value of b do not matter, because the minimum is b there. So each value is required only in an interval;
/// outside of it, only the side matters (required_interval.hpp). In a long chain of minima, this prunes the links that
/// are far from the region, wherever they are in the chain, even if each link is too close to the next to be pruned by
/// value.
///
/// Where a value lies in its required interval, ends included, its replacement equals it. Elsewhere, both lie on the
/// same side of the interval. Both operands of min(a, b) may be replaced at once, a by a′ and b by b′. Let the minimum
/// be required in [l, u], and let A and B be the largest values of a and b in the region. Then a is required in [l,
/// min(u, B)] and b in [l, min(u, A)]. Where a ≤ b (and likewise where b ≤ a),
///     l ≤ a ≤ u   a′ = a, because a ≤ b ≤ B;   b′ = b ≥ a or b′ > min(u, A) ≥ a   so min(a′, b′) = a
///     a > u       a′ > u;                      b′ > u, because b ≥ a > u          so min(a′, b′) > u
///     a < l       a′ < l                                                          so min(a′, b′) < l
/// A replacement has the same sign relative to each threshold and is itself Lipschitz. So its distance from the
/// threshold is still a lower bound on the distance to where the sign changes.
///
/// *A replacement is no steeper than the value's recorded bound* (WorkingProgram::lipschitz), so the components of a
/// pruned program are 1-Lipschitz in the region. The proof is by induction over the instructions, from the first to the
/// last; operations are those of program.hpp.
///   - An instruction that is kept has the bound that follows from the bounds of its operands, with three exceptions.
///     `corner` is no steeper than its steeper operand because its operands vary along orthogonal directions; an
///     operand's replacement is made of parts of it, so it varies along the same directions. `guarded` is as steep as
///     its first operand, which is required everywhere and hence is not changed. A node may prove a bound on its own
///     (`one_lipschitz` in tree/domain.hpp) that is smaller than the one that follows from its operands, as a blob does
///     for its sum of `falloff`s. Each falloff is required wherever it is not zero, so none of them is changed.
///   - An operand that replaces a minimum, a maximum, a smooth minimum or a corner is no steeper than the steeper
///     operand, which is the instruction's bound. An operand that replaces a sum whose other operand is zero is no
///     steeper than the sum of both bounds.
///   - The maximum that replaces `guarded` gets the bound of its steeper operand.
///
/// Functions here use types of the namespace `rewriting`. A WorkingProgram is a program derived from an object's
/// program for a part of space. ProgramContext holds what all of these share: constants, the error bound, the opaque
/// phases. Arenas are where results and scratch data are allocated. RequiredOfLocal names a primitive that can be
/// specialised to a small box (LocalPrimitive in model/concepts.hpp), and the largest of its values that matters. The
/// sweep uses LiveSet (the instructions on which outputs depend) and SignedValue (a value or its negative).
namespace phasetree::pruning {

using bounding::ValueRanges;
using evaluation::ValuesAtPoint;
using rewriting::Arena, rewriting::Arenas, rewriting::ProgramContext, rewriting::RequiredOfLocal,
    rewriting::WorkingProgram;

/// The range of every value in a ball, from the values at its centre and their Lipschitz bounds: |v(p) − v(centre)| ≤
/// slope · radius. Ranges are computed on demand.
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

/// Prunes a program for a region, given the ranges of its values there. Returns nullopt if no ray can meet an interface
/// in the region: an interface needs two phases, at least one of them not opaque. The result is allocated in `results`.
/// If nothing can be deleted from the program, the program itself may be returned.
///
/// In the region, the result gives the same labels (the phases with the smallest components), and the absolute values
/// of its components are still lower bounds on the distance to where the label changes.
std::optional<WorkingProgram> prune(const WorkingProgram&, const ValueRanges&, const ProgramContext&, const Arenas&);
std::optional<WorkingProgram> prune(const WorkingProgram&, const RangesInBall&, const ProgramContext&, const Arenas&);
/// Does the same, and also returns the largest values that matter of local primitives. In smaller boxes, where
/// instructions are renumbered, a primitive is recognised by the index of its constants (Specialisation::source). So
/// primitives of several instructions that share constants are left out.
std::optional<WorkingProgram> prune(const WorkingProgram&, const RangesInBall&, const ProgramContext&, const Arenas&,
                                    std::span<const RequiredOfLocal>& required);

/// Removes the operations that enlarge distances far from the surface (Op::far_bound), which change no sign. Returns
/// nullopt if the program has none, or if no interface is left.
std::optional<WorkingProgram> without_far_bounds(const WorkingProgram&, const ProgramContext&, const Arenas&);

}  // namespace phasetree::pruning
