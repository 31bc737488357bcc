// The tentacle of the scaling experiments, in the manner of scenes/tentacle.json, with any number of bumps: a curved,
// tapering core of round cones, muscle and skin in layers about it, and balls of a fourth phase half in the skin, along
// a Fibonacci spiral. The balls' radii are in proportion to the arm's where they sit, and together they cover the same
// share of the skin whatever their number. Each phase is cut by a plane-sided shape of its own at the arm's foot, so
// that camera rays meet all of them.
#pragma once

#include "phasetree/model/handle.hpp"

namespace phasetree::bench {

Phased tentacle(int bumps);

}  // namespace phasetree::bench
