#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "phasetree/program/program.hpp"

/// How the equations of nodes become functions of GLSL. An instruction's equation is run once over a number type that
/// writes down what is computed (traced.hpp). What it wrote is a trace: straight-line code in which every loop of the
/// equation is unrolled and every parameter is a number. Loops are found again in it (loops.hpp), and traces that
/// differ only in numbers become one function whose numbers are data (functions.hpp).
namespace phasetree::glsl {

enum class TraceOp : std::uint8_t {
    negate,
    add,
    subtract,
    multiply,
    divide,
    less,    ///< a < b, which only `select` takes
    select,  ///< a ? b : c
    minimum,
    maximum,
    absolute,
    root,
    floor,
    lookup,  ///< the float at `table` + a of the instruction's data, for whole a
    call     ///< a function that equations share
};

/// Functions that equations share, and that are not written out in each of them.
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

/// The steps of an equation in order. Values 0 … inputs − 1 are what it takes, value inputs + i is that of step i.
struct Trace {
    std::uint32_t inputs = 0;
    std::vector<TraceStep> steps;
    std::vector<Operand> results;  ///< one number, or the three of a point
    std::span<const float> data;   ///< of the instruction, if a step is a lookup in it
    bool has_lookup = false;
};

/// The trace of an operation of programs, with its constants. It takes a point's three coordinates, or one or two
/// numbers.
Trace trace_of(Op, std::span<const float> constants);
/// The trace of a function that equations share.
Trace trace_of(SharedFunction);

}  // namespace phasetree::glsl
