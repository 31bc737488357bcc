#pragma once

#include "phasetree/nodes/fields/ball_list.hpp"

namespace phasetree::bench {

// About this many balls of four phases in a cube of side 1: on a lattice, each moved at random by up to a fifth of the
// spacing along each axis, with radii of 0.3 to 0.5 of it. Some overlap.
BallList packing(std::size_t balls);

}  // namespace phasetree::bench
