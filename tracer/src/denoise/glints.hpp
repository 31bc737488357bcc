// Single pixels that are much brighter than their surroundings, such as the sun in the edge of a glass. A filter would
// turn them into white spots, because their noise is as large as their value and makes them similar to everything
// around. They are excluded from the filter for their neighbours, and kept as they were sampled, so that no light is
// lost.
#pragma once

#include <cstdint>

#include "denoise/halves.hpp"

namespace phasetree::tracer {

/// 1 where a pixel is a glint: brighter than 32 times the median of the 24 pixels around it and 32 times the picture's
/// mean. The latter condition excludes pixels in dark areas whose brightness is usual elsewhere. 0 in the margin.
Grid<std::uint8_t> glints_of(const Grid<Estimate<3>>& picture);

}  // namespace phasetree::tracer
