#pragma once

#include "glsl/nest.hpp"

namespace phasetree::glsl {

/// Finds the loops of a trace: stretches of steps that repeat. Short ones are tried first, so that nested loops are
/// found from the inside out. Repetitions that are not worth a loop, or whose operands follow no regular pattern, stay
/// as they are.
std::vector<NestItem> find_loops(const Trace&);

}  // namespace phasetree::glsl
