// The text that all shaders share, independent of any node.
#pragma once

namespace phasetree::glsl {

/// Arithmetic with gradients, as in math/dual.hpp: a vec4 contains the gradient and, in w, the value.
extern const char* const gradient_arithmetic;

/// Labels and normals from phasetree_distances() and phasetree_gradients(), which are written as calls.
extern const char* const calls_sampler;

/// The same two functions, implemented by the program at PT_WHOLE of a table (program_table.hpp).
extern const char* const table_evaluation;
/// Labels and normals from programs of the table. It must be preceded by pt_program(), which selects the program.
extern const char* const table_sampler;
/// The selection of a program: that of the whole object, or that of the box around a point.
extern const char* const one_program;
extern const char* const one_program_sampler;
extern const char* const grid_of_programs;
extern const char* const grid_sampler;

/// Traces rays from phase to phase, using any of the above.
extern const char* const phase_tracer;

}  // namespace phasetree::glsl
