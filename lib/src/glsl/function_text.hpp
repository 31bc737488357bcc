#pragma once

#include <string>
#include <vector>

#include "glsl/trace.hpp"

namespace phasetree::glsl {

/// Numbers of a function, which stand in its text as \x01 n \x02: one, or a table of several, of which an index chooses
/// one.
struct NumberSlot {
    std::vector<float> numbers;
    bool is_table = false;
};

/// The body of a function as text. Functions whose texts are the same differ in their numbers at most.
struct FunctionText {
    std::string values;             ///< over floats
    std::string slopes;             ///< over numbers with gradients: see dual_text.hpp
    std::vector<NumberSlot> slots;  ///< of either, in the order in which `values` has them and then `slopes`
    std::vector<SharedFunction> calls;
    bool has_lookup = false;
};

/// A function takes x, y, z, as many as the trace has inputs, and `at`, where its numbers begin. It returns a float or
/// a vec3; over numbers with gradients a vec4, or a mat3x4 whose columns are the three.
FunctionText text_of(const Trace&);

/// The name of a function that equations share.
const char* name_of(SharedFunction);

/// A number as GLSL writes it.
std::string literal(float);

}  // namespace phasetree::glsl
