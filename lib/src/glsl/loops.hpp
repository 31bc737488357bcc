#pragma once

#include "glsl/nest.hpp"

namespace phasetree::glsl {

/// Finds the loops of a trace: stretches of steps that repeat. Short ones are sought first, so that loops in loops are
/// found from the inside; what repeats and is not worth a loop, or reads its operands in no regular way, stays as it
/// is.
std::vector<NestItem> find_loops(const Trace&);

}  // namespace phasetree::glsl
