// The small bright parts of an environment, such as the sun in a photograph of the sky: what throws caustics. Photons
// are sent from these alone, because light from all around makes none.
//
// A part grows from the brightest cell of the environment's distribution over all neighbours that have an eighth of its
// luminance, and is the cap around them. The next one grows from the brightest cell that is in no cap yet, while that
// is much brighter than the mean. This is a heuristic of where to look: whatever is chosen, what photons bring is
// weighted by the density with which they were sent, and the rest is left to other techniques.
#pragma once

#include <vector>

#include "lights/cap.hpp"
#include "lights/lat_long_distribution.hpp"

namespace phasetree::tracer {

/// At most four, the brightest first, of what is sampled in proportion to its luminance.
std::vector<Cap> bright_parts(const LatLongDistribution& distribution);

}  // namespace phasetree::tracer
