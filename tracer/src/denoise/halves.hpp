// A picture as denoising sees it: in two halves of its samples, which are independent, with what is known of the
// surfaces that it shows.
#pragma once

#include <array>
#include <cstddef>

#include "denoise/grid.hpp"
#include "film/image.hpp"

namespace phasetree::tracer {

template <std::size_t N>
struct Estimate {
    std::array<float, N> mean{};
    std::array<float, N> variance{};  ///< of that mean
};

/// What guides the filter: albedo and normal of the first surface, and of the first that is not perfectly smooth.
inline constexpr std::size_t feature_count = 12;

struct Halves {
    Halves(int width, int height)
        : pictures{Grid<Estimate<3>>(width, height), Grid<Estimate<3>>(width, height)},
          shares(width, height),
          features(width, height) {}

    /// The radiance by each half. The variances are as the difference of the halves tells, averaged over 3×3 pixels.
    std::array<Grid<Estimate<3>>, 2> pictures;
    /// Which part of a pixel's samples is in the first half.
    Grid<float> shares;
    /// By all samples.
    Grid<Estimate<feature_count>> features;
};

/// Takes them from the channels of the planes that denoising_planes() lists (denoise.hpp). Throws DenoiseError if one
/// is missing, or if a pixel lacks samples in one of the halves.
Halves halves_of(const Image& image);

}  // namespace phasetree::tracer
