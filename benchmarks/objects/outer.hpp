#pragma once

#include "phasetree/model/handle.hpp"

namespace phasetree::bench {

// An object as its surface alone: one phase, whose boundary is the boundary of the vacuum. Its field is −φ₀, which has
// no zeros inside as the merged phases' minimum has.
Phased outer(const Phased& object);

}  // namespace phasetree::bench
