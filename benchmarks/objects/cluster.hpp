#pragma once

#include "phasetree/model/handle.hpp"

namespace phasetree::bench {

// A cluster of 96 balls and rounded boxes that overlap, the i-th of phase 1 + i mod n. Whatever n, the surface is the
// same.
Phased cluster(int phases);

}  // namespace phasetree::bench
