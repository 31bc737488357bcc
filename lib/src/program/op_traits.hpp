#pragma once

#include <array>
#include <cstdint>

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// The properties of an operation.
struct OpTraits {
    std::uint8_t operands = 1;  ///< the number of operand values
    /// A rough estimate of its cost. A simple operation such as an addition costs 2.
    std::uint16_t half_instructions = 2;
    std::uint16_t floats_read = 0;        ///< how many of its floats an evaluation reads; 0 means nearly all
    bool gives_point = false;             ///< its result is a point instead of a number
    bool has_constant = false;            ///< its data is a single constant
    bool is_long_primitive = false;       ///< a primitive whose equation is long (concepts.hpp)
    bool has_cost_in_data = false;        ///< its cost depends on its data (HasCostInData)
    bool is_best_in_small_boxes = false;  ///< it is expensive, and its bounds are much better in small boxes
    bool is_fold = false;                 ///< it folds space, so it is not continuous
    bool is_pattern = false;              ///< a PatternPrimitive or a PatternDataPrimitive: it has a period
    bool is_voxel_grid = false;           ///< a PatternDataPrimitive
    bool is_local = false;        ///< a LocalPrimitive or a LocalDataPrimitive: only a small part of it matters in a
                                  ///< small box
    bool has_many_parts = false;  ///< a PrimitiveOfParts
    bool is_specialised = false;  ///< the form that a LocalPrimitive takes in a small box
};
/// The maximum number of operations, including those of fused.hpp.
inline constexpr std::size_t max_operations = 256;
/// The properties of all operations, indexed by operation.
extern const std::array<OpTraits, max_operations> op_traits;

inline const OpTraits& traits(Op op) {
    return op_traits[static_cast<std::size_t>(op)];
}
inline int operands(Op op) {
    return traits(op).operands;
}
inline bool has_constant(Op op) {
    return traits(op).has_constant;
}
inline bool gives_point(Op op) {
    return traits(op).gives_point;
}
inline bool is_long_primitive(Op op) {
    return traits(op).is_long_primitive;
}
inline bool is_fold(Op op) {
    return traits(op).is_fold;
}
/// Whether an operation adds a far bound, which only enlarges distances far from the surface.
inline bool is_far_bound(Op op) {
    return op == Op::far_bound || op == Op::far_bound_inside;
}

}  // namespace phasetree::program
