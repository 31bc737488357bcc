#pragma once

#include <string>
#include <vector>

#include "glsl/trace.hpp"

namespace phasetree::glsl {

/// A text marks where the number n of `slots` stands by \x01 n \x02, and where the table of its lookups begins by
/// \x01 L \x02, each without the blanks. The caller puts numbers or offsets in a buffer there.
///
/// A slot holds one number, or a table of which an index chooses one.
struct NumberSlot {
    std::vector<float> numbers;
    bool is_table = false;
};

/// The body of a function as text. Functions whose texts are the same differ in their numbers at most.
struct FunctionText {
    std::string float_body;             ///< This body computes with floats.
    std::string dual_body;              ///< This one computes with dual numbers: values with gradients.
    std::vector<NumberSlot> slots;      ///< The markers of both bodies are indices into these.
    std::vector<SharedFunction> calls;  ///< Both bodies call these.
    bool has_lookup = false;
};

/// The caller writes the signature: the parameters are x, y and z, as many as the trace has inputs, and `at`, where the
/// function's numbers begin. The float body returns a float or a vec3, the dual body a vec4 (gradient, value) or a
/// mat3x4 whose columns are three of these. Throws std::logic_error if a step has no form in GLSL.
FunctionText text_of(const Trace&);

/// The name of a function that equations share.
const char* name_of(SharedFunction);

/// A number as GLSL writes it.
std::string literal(float);

}  // namespace phasetree::glsl
