#pragma once

#include <cstdint>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// The operations of a program. Primitives and maps of space follow, one a type of the node list, each a single
/// instruction: opcode = first_primitive + index in Primitives, then DataPrimitives, then PointMaps.
enum class Op : std::uint16_t {
    input,              ///< the point itself
    negate,             ///< −a
    add,                ///< a + b
    subtract,           ///< a − b
    minimum,            ///< a < b ? a : b
    maximum,            ///< a > b ? a : b
    far_bound,          ///< the maximum, where a alone has the sign
    far_bound_inside,   ///< the minimum, where a alone has the sign
    absolute,           ///< |a|
    add_constant,       ///< a + c
    constant_minus,     ///< c − a
    multiply_constant,  ///< a · c
    smooth_minimum,     ///< smin(a, b, r = c)
    guarded,            ///< max(a, min(b, c − a))
    falloff,            ///< (1 − (a/c)²)³, zero for a > c
    corner,  ///< |(max(a, 0), max(b, 0))| + min(max(a, b), 0), where a and b vary along orthogonal directions
    first_primitive
};

/// One instruction of a program: defines the value of its own index from values of lower index. Primitives and
/// maps take the point `a`; `data` is where their floats, or the constant, start among the program's constants.
struct Instruction {
    Op op{};
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t data = 0;
};

struct Output {
    Phase phase;
    std::uint32_t value = 0;
};

/// A tree recorded into a flat list of instructions without duplicates. Absent phases and shared subtrees cost nothing:
/// they never become instructions. Immutable once recorded; any thread may read it.
struct Program {
    std::vector<Instruction> instructions;  ///< instructions[0] is the input point
    std::vector<float> constants;
    std::vector<Output> outputs;  ///< in rising order of phases
    /// A Lipschitz bound of each value (for a point: of the map from the input), what pruning needs.
    std::vector<float> lipschitz;

    std::size_t bytes() const;
};

/// Records an object. Throws ModelError if it grows past `limit` instructions (a tree of shared subtrees under
/// different transforms can be exponentially larger than its nodes).
Program record(const Phased&, std::size_t limit = 500'000);
/// Records a plain field as the phase 1 with its vacuum.
Program record(const Field&, std::size_t limit = 500'000);

}  // namespace phasetree
