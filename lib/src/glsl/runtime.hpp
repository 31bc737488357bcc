#pragma once

/// The text that all shaders have in common, which depends on no node.
namespace phasetree::glsl {

/// Arithmetic of numbers with gradients, as math/dual.hpp has it: a vec4 is the gradient and, as its w, the value.
extern const char* const gradient_arithmetic;

/// Labels and normals by phasetree_distances() and phasetree_gradients() that are written as calls.
extern const char* const calls_sampler;

/// The same two by the program at PT_WHOLE of a table (program_table.hpp).
extern const char* const table_evaluation;
/// Labels and normals by programs of the table. pt_program(), which says which, must stand before it.
extern const char* const table_sampler;
/// Which program: that of the whole object, or that of the box around a point.
extern const char* const one_program;
extern const char* const one_program_sampler;
extern const char* const grid_of_programs;
extern const char* const grid_sampler;

/// What traces rays from phase to phase, by any of these.
extern const char* const phase_tracer;

}  // namespace phasetree::glsl
