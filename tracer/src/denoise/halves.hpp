// The input of denoising: a picture in two independent halves of its samples, and features of the visible surfaces.
#pragma once

#include <array>
#include <cstddef>

#include "denoise/grid.hpp"
#include "film/image.hpp"

namespace phasetree::tracer {

template <std::size_t N>
struct Estimate {
    std::array<float, N> mean{};
    std::array<float, N> variance{};  ///< of the mean
};

/// The features that guide the filter: albedo and normal of the first surface, and of the first that is not perfectly
/// smooth.
inline constexpr std::size_t feature_count = 12;

struct Halves {
    Halves(int width, int height)
        : pictures{Grid<Estimate<3>>(width, height), Grid<Estimate<3>>(width, height)},
          shares(width, height),
          features(width, height) {}

    /// The radiance of each half. Variances are estimated from the difference of the halves, averaged over 3×3 pixels.
    std::array<Grid<Estimate<3>>, 2> pictures;
    /// The share of a pixel's samples in the first half.
    Grid<float> shares;
    /// From all samples.
    Grid<Estimate<feature_count>> features;
};

/// Reads them from the channels of the planes in denoising_planes() (denoise.hpp). Throws DenoiseError if one is
/// missing, or if a pixel lacks samples in one of the halves.
Halves halves_of(const Image& image);

}  // namespace phasetree::tracer
