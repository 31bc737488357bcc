#pragma once

#include <string>
#include <vector>

#include "glsl/trace.hpp"

namespace phasetree::glsl {

/// Bodies contain markers: \x01 n \x02 (without the blanks) stands for the number in slot n, and \x01 L \x02 for the
/// start of the table for its lookups. The caller replaces them by numbers or by offsets into a buffer.
///
/// A slot contains one number, or a table from which an index selects a number.
struct NumberSlot {
    std::vector<float> numbers;
    bool is_table = false;
};

/// The body of a function as text. Functions with equal texts differ at most in their numbers.
struct FunctionText {
    std::string float_body;             ///< computes with floats
    std::string dual_body;              ///< computes with dual numbers: values with gradients
    std::vector<NumberSlot> slots;      ///< the markers of both bodies are indices into these
    std::vector<SharedFunction> calls;  ///< called by both bodies
    bool has_lookup = false;
};

/// Returns the bodies of the function that computes a trace. The caller writes the signature: the parameters are x, y
/// and z, as many as the trace has inputs, and `at`, the offset of the function's numbers. The float body returns a
/// float or a vec3. The dual body returns a vec4 (gradient, value), or a mat3x4 with three of these as columns. Throws
/// std::logic_error if a step cannot be expressed in GLSL.
FunctionText text_of(const Trace&);

/// The name of a shared function.
const char* name_of(SharedFunction);

/// A number as a GLSL literal.
std::string literal(float);

}  // namespace phasetree::glsl
