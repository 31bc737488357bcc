// Where a render may stop early: blocks of pixels whose estimated error is small enough.
//
// The error of a pixel is the standard error of its mean luminance, over that mean, or over a hundredth of what is
// shown as white at the scene's exposure where the mean is less. The error of a block of 8×8 pixels of the picture is
// the root mean square of those of its pixels. All of its pixels stop together: one that looks black because nothing
// bright was found yet goes on with its neighbours.
//
// Whoever stops when the noise looks small stops a little too often where it was underestimated, which is where bright
// paths were missed: a bias (Kirk & Arvo, Unbiased Sampling Techniques for Image Synthesis, SIGGRAPH 1991). So blocks
// are examined seldom, after 32, 48, 64, 96, 128, 192, … samples a pixel: at the first look a block has 2,048. And a
// bright path raises its pixel's mean as well as its error, so that pixel counts with an error of about 1, however
// bright the path is (tests/tracer/noise_limit.cpp measures the bias that is left).
//
// Whether a block goes on follows from its own samples and from their number alone: not from other blocks, nor from
// threads, nor from when a render was interrupted.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "film/film.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// The side of blocks, in pixels.
inline constexpr int block_side = 8;

/// The blocks of the picture that touch an area, cut off where the area ends.
std::vector<PixelRange> blocks_of(const PixelRange& area);
/// The smallest area of whole blocks of the picture around one.
PixelRange whole_blocks(const PixelRange& area, const FilmSettings& film);

class NoiseLimit {
  public:
    /// Nothing if the settings ask for none.
    static std::optional<NoiseLimit> of(const RenderSettings& settings);

    /// After how many samples a pixel, more than `done`, a block is examined next.
    static int next_look(int done);
    static bool is_look(int samples) { return samples > 0 && next_look(samples - 1) == samples; }

    /// Whether a block has done enough: all of its pixels have one number of samples, after which it is examined, and
    /// its error is at most the limit. The film keeps the plane "noise".
    bool is_met(const FilmTile& pixels, const PixelRange& block) const;
    /// The error of a block whose pixels have samples.
    double error(const FilmTile& pixels, const PixelRange& block) const;

  private:
    NoiseLimit(double limit, double darkest) : limit_(limit), darkest_(darkest) {}

    double limit_;
    double darkest_;  // luminance by which an error is divided at least
};

}  // namespace phasetree::tracer
