// Single pixels that are very much brighter than what is around them: the sun in the edge of a glass. A filter would
// make white spots of them, because their noise is as large as they are and they are like everything within it. They
// are left out of what their neighbours are made of, and stay as they were sampled, so that no light is lost.
#pragma once

#include <cstdint>

#include "denoise/halves.hpp"

namespace phasetree::tracer {

/// 1 where a pixel of a picture is a glint, which is brighter than 32 times the median of the 24 pixels around them,
/// and than 32 times the picture's mean, so that in dark places none is whose brightness is usual elsewhere. It is 0 in
/// the margin.
Grid<std::uint8_t> glints_of(const Grid<Estimate<3>>& picture);

}  // namespace phasetree::tracer
