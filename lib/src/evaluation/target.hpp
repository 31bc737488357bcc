#pragma once

#include "kernel/kernel.hpp"

namespace phasetree::evaluation {

using kernel::Kernel;

/// The kernel of the instruction set in use.
const Kernel& active_kernel();

}  // namespace phasetree::evaluation
