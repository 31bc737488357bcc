// Conversion of display values in [0, 1] to the integers of a file.
//
// With eight bits, the gradient of a smooth sky shows bands. quantise8 therefore dithers: it rounds by a threshold u(x,
// y) that covers (0, 1) evenly in every small neighbourhood, code = floor(255 v + u). The mean over a neighbourhood is
// then the value itself, each pixel is off by less than one code, and values that are exactly codes (black, white, a
// flat graphic) are unchanged. u is the additive recurrence of the plastic number (M. Roberts, "The Unreasonable
// Effectiveness of Quasirandom Sequences", 2018) in integers, so the bits are the same on every machine. All three
// channels share it, so neutral pixels stay neutral. Sixteen bits need no dithering.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phasetree::tracer {

/// The rounding threshold at a pixel, an odd multiple of 1/512 in (0, 1).
float dither_threshold(int x, int y);

/// Dithered 8-bit codes, three per pixel. x0, y0 is the absolute position of the first pixel, so that a crop gets the
/// same codes as the whole picture. Values below 0 and NaN become 0, values above 1 become 255.
std::vector<std::uint8_t> quantise8(std::span<const glm::vec3> pixels, int width, int x0, int y0);

/// 16-bit codes, three per pixel, rounded to nearest and clamped in the same way.
std::vector<std::uint16_t> quantise16(std::span<const glm::vec3> pixels);

}  // namespace phasetree::tracer
