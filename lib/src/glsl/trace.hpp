#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "phasetree/program/program.hpp"

/// Translates the equations of nodes to GLSL functions. An instruction's equation is run once with a number type that
/// records every computation (traced.hpp). The result is a trace: straight-line code in which all loops of the equation
/// are unrolled and all parameters are numbers. Loops are then recovered from it (loops.hpp), and traces that differ
/// only in numbers become a single function whose numbers are data (functions.hpp).
namespace phasetree::glsl {

enum class TraceOp : std::uint8_t {
    negate,
    add,
    subtract,
    multiply,
    divide,
    less,    ///< a < b; only `select` takes it
    select,  ///< a ? b : c
    minimum,
    maximum,
    absolute,
    root,
    floor,
    lookup,  ///< the float at index `table` + a of the instruction's data, for integer a
    call     ///< a call of a shared function
};

/// Functions that equations share instead of containing copies of them.
enum class SharedFunction : std::uint8_t { none, sine, sine_of_pair, cosine_of_pair, angle, space_noise };

/// A value of a trace, or a number.
struct Operand {
    static constexpr std::int32_t number = -1;
    std::int32_t value = number;
    float constant = 0;

    bool is_number() const { return value == number; }
};

struct TraceStep {
    TraceOp op{};
    SharedFunction function = SharedFunction::none;
    std::uint8_t operands = 0;
    std::uint32_t table = 0;
    std::array<Operand, 3> in{};
};

/// The steps of an equation in order. Values 0 … inputs − 1 are its parameters; value inputs + i is the result of step
/// i.
struct Trace {
    std::uint32_t inputs = 0;
    std::vector<TraceStep> steps;
    std::vector<Operand> results;  ///< one number, or the three coordinates of a point
    std::span<const float> data;   ///< of the instruction, if a step looks it up
    bool has_lookup = false;
};

/// Whether the inputs of an operation are the coordinates of a point, instead of numbers.
inline bool takes_point(Op op) {
    return op >= Op::first_primitive;
}
/// The trace of a program operation with its constants. Its inputs are the three coordinates of a point, or one or two
/// numbers.
Trace trace_of(Op, std::span<const float> constants);
/// The trace of a shared function.
Trace trace_of(SharedFunction);

}  // namespace phasetree::glsl
