#pragma once

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// Removes the instructions that no output needs. Recording leaves some, because operators compute components that the
/// node above may not use.
Program without_dead_code(Program);

}  // namespace phasetree::program
