// The small bright parts of an environment that cause caustics, such as the sun in a photograph of the sky. Only they
// emit photons, because light from all directions causes no caustics.
//
// A part grows from the brightest cell of the environment's distribution over all neighbours with at least an eighth of
// its luminance. The part is the cap around these cells. The next part grows from the brightest cell outside all caps,
// while that is much brighter than the mean. The heuristic affects noise only: photons are weighted by the density with
// which they were emitted, and the other light is left to other techniques.
#pragma once

#include <vector>

#include "lights/cap.hpp"
#include "lights/lat_long_distribution.hpp"

namespace phasetree::tracer {

/// At most four parts, the brightest first. The distribution must be proportional to luminance.
std::vector<Cap> bright_parts(const LatLongDistribution& distribution);

}  // namespace phasetree::tracer
