#pragma once

#include <cstdint>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// The operations of a program, with operands a and b and a constant c. The operations of primitives and maps of space
/// start at first_primitive: one per type in Primitives, then DataPrimitives, then PointMaps (nodes/list.hpp).
enum class Op : std::uint16_t {
    input,              ///< the point itself
    negate,             ///< −a
    add,                ///< a + b
    subtract,           ///< a − b
    minimum,            ///< a < b ? a : b
    maximum,            ///< a > b ? a : b
    far_bound,          ///< max(a, b): a field a, and a bound b that exceeds it far outside; the sign is that of a
    far_bound_inside,   ///< min(a, b): a field a, and a bound b that is below it far inside; the sign is that of a
    absolute,           ///< |a|
    add_constant,       ///< a + c
    constant_minus,     ///< c − a
    multiply_constant,  ///< a · c
    smooth_minimum,     ///< smin(a, b, r = c)
    guarded,  ///< max(a, min(b, c − a)): field b with a bound a; equals a where a ≥ c/2, so b may jump there
    falloff,  ///< (1 − (a/c)²)³, zero for a > c
    corner,   ///< |(max(a, 0), max(b, 0))| + min(max(a, b), 0), where a and b vary along orthogonal directions
    nearer,   ///< max((a − b)/2, a): the part of solid a where b is not the nearer solid
    first_primitive
};

/// One instruction of a program. Instruction i computes value i from the values a and b, whose indices are lower.
/// Primitives and maps of space take the point `a`.
struct Instruction {
    Op op{};
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    /// Where this instruction's constants start in Program::constants. Constants are stored in the order of the
    /// instructions, without gaps, so they end where the next instruction's start.
    std::uint32_t data = 0;
};

/// One component of Φ, and the index of its value.
struct Output {
    Phase phase;
    std::uint32_t value = 0;
};

/// A tree recorded as a flat list of instructions without duplicates. Absent phases produce no instructions. A shared
/// subtree is recorded once per map of space that applies to it. Immutable once recorded; any thread may read it.
struct Program {
    std::vector<Instruction> instructions;  ///< instructions[0] is the input point
    std::vector<float> constants;
    std::vector<Output> outputs;  ///< in ascending order of phases
    /// A Lipschitz bound of each value as a function of the input point, used for pruning. For a value that is a point,
    /// it bounds the map from the input.
    std::vector<float> lipschitz;

    std::size_t bytes() const;
};

/// Record an object. Throws ModelError if that takes more than `limit` instructions. A tree that shares subtrees under
/// different transforms can need exponentially more instructions than it has nodes.
Program record(const Phased&, std::size_t limit = 500'000);
/// Record a field as an object of phase 1 and the vacuum; otherwise the same.
Program record(const Field&, std::size_t limit = 500'000);

}  // namespace phasetree
