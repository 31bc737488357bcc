#pragma once

/// The text that all shaders have in common, which depends on no node.
namespace phasetree::glsl {

/// Arithmetic of numbers with gradients, as math/dual.hpp has it: a vec4 is the gradient and, as its w, the value.
extern const char* const gradient_arithmetic;
/// What reads Φ: the label, the interface distance, and the tracer from phase to phase. It needs phasetree_distances()
/// and phasetree_gradients() before it.
extern const char* const phase_tracer;

}  // namespace phasetree::glsl
