// From display values in [0, 1] to the integers of a file.
//
// Eight bits are too few for a smooth sky: without help its gradient falls into bands. quantise8 therefore rounds up or
// down by a threshold u(x, y) that covers (0, 1) evenly in every small neighbourhood: code = floor(255 v + u). The mean
// over a neighbourhood is then the value itself, every single pixel is wrong by less than one code, and values that are
// codes already (black, white, a flat graphic) stay clean. u is the additive recurrence of the plastic number,
// M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences" (2018), in integers, hence the same bits
// everywhere. All three channels share it: a neutral pixel stays neutral. Sixteen bits need no such help.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phasetree::tracer {

/// The rounding threshold at a pixel, an odd multiple of 1/512 in (0, 1).
float dither_threshold(int x, int y);

/// Dithered 8-bit codes, three a pixel; x0, y0 is the absolute position of the first pixel, so that a crop gets the
/// same codes as the whole picture. What is below 0 or no number becomes 0, what is above 1 becomes 255.
std::vector<std::uint8_t> quantise8(std::span<const glm::vec3> pixels, int width, int x0, int y0);

/// 16-bit codes, three a pixel, rounded to nearest and clamped likewise.
std::vector<std::uint16_t> quantise16(std::span<const glm::vec3> pixels);

}  // namespace phasetree::tracer
