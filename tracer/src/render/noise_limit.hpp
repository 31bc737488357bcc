// Adaptive sampling: stops blocks of pixels whose estimated error is small enough.
//
// The error of a pixel is the standard error of its mean luminance, relative to that mean. The divisor is at least a
// hundredth of what appears white at the scene's exposure. The error of a block of 8×8 pixels of the picture is the
// root mean square of those of its pixels. All pixels of a block stop together: a pixel that looks black only because
// no path has found light yet continues with its neighbours.
//
// Stopping when the noise looks small causes a bias: rendering stops too often where the noise was underestimated,
// which is where bright paths were missed (Kirk & Arvo, Unbiased Sampling Techniques for Image Synthesis, SIGGRAPH
// 1991). Blocks are therefore tested only after 32, 48, 64, 96, 128, 192, … samples per pixel: at the first test, a
// block has 2,048. A bright path raises the mean of its pixel as well as the error, so that pixel has an error of about
// 1, however bright the path is (tests/tracer/render/noise_limit.cpp measures the remaining bias).
//
// Whether a block continues depends only on its own samples and their number, not on other blocks, threads, or
// interruptions of a render.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "film/film.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// The side length of blocks, in pixels.
inline constexpr int block_side = 8;

/// The blocks of the picture that overlap an area, clipped to the area.
std::vector<PixelRange> blocks_of(const PixelRange& area);
/// The smallest area of whole blocks of the picture that contains an area.
PixelRange whole_blocks(const PixelRange& area, const FilmSettings& film);

class NoiseLimit {
  public:
    /// nullopt if the settings have no limit.
    static std::optional<NoiseLimit> of(const RenderSettings& settings);

    /// The number of samples per pixel, more than `done`, after which blocks are tested next.
    static int next_look(int done);
    static bool is_look(int samples) { return samples > 0 && next_look(samples - 1) == samples; }

    /// Whether a block can stop: all its pixels have the same number of samples, which is one after which blocks are
    /// tested, and its error is at most the limit. The film must have the plane "noise".
    bool is_met(const FilmTile& pixels, const PixelRange& block) const;
    /// The error of a block whose pixels have samples.
    double error(const FilmTile& pixels, const PixelRange& block) const;

  private:
    NoiseLimit(double limit, double darkest) : limit_(limit), darkest_(darkest) {}

    double limit_;
    double darkest_;  // minimum luminance by which an error is divided
};

}  // namespace phasetree::tracer
