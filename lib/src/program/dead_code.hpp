#pragma once

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// The program without the instructions that no output needs. Recording leaves some, because operators compute
/// components which a node above may not use.
Program without_dead_code(Program);

}  // namespace phasetree::program
