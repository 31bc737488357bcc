#pragma once

#include "kernel/kernel.hpp"

namespace phasetree {

/// The kernel of the instruction set in use.
const Kernel& active_kernel();

}  // namespace phasetree
