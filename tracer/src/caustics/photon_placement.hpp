// Where a photon is kept on its line through a medium that scatters, and for which places of the line it counts.
//
// A line is kept by one place of it, at a depth t behind the boundary. It is sampled as a free flight in one of the n
// colour channels that scatter, each of them as often,
//     p(t) = Σ σt_c exp(−σt_c t)/n,
// whether or not the photon is scattered there: it goes on behind as light that was not. The place counts for all
// points of the line that are within h of it. So the point at the depth t is covered with the probability
//     F(t) = ∫ p over [t − h, t + h] = Σ (exp(−σt_c max(t − h, 0)) − exp(−σt_c (t + h)))/n,
// and what the line brings there, its power times the transmittance T(t), counts 1/F(t) times. Across the line photons
// are gathered in a disc, as those on a surface are; along it nothing is blurred. Only media whose transmittance has a
// closed form are lit so, which are the homogeneous ones.
//
// This is a short beam of Jarosz, Nowrouzezahrai, Sadeghi & Jensen, A Comprehensive Theory of Volumetric Radiance
// Estimation Using Photon Points and Beams, TOG 30(1), 2011, gathered at a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>

#include "media/medium.hpp"

namespace phasetree::tracer {

class PhotonPlacement {
  public:
    /// Nothing for a medium that photons do not light.
    static std::optional<PhotonPlacement> in(const Medium& medium) {
        const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium);
        if (!homogeneous) return std::nullopt;
        const ScatteringCoefficients& coefficients = homogeneous->coefficients();
        PhotonPlacement placement;
        for (int c = 0; c < 3; ++c)
            if (coefficients.scattering[c] > 0.0f)
                placement.extinction_[placement.channels_++] = coefficients.extinction()[c];
        return placement.channels_ > 0 ? std::optional(placement) : std::nullopt;
    }

    /// A depth, with u in [0, 1).
    float sample(float u) const {
        const float at = u * static_cast<float>(channels_);
        const std::size_t channel = std::min(static_cast<std::size_t>(at), channels_ - 1);
        return -std::log1p(-std::min(at - static_cast<float>(channel), 0x1.fffffep-1f)) / extinction_[channel];
    }
    /// F(depth) for the half length h of what a place counts for.
    float coverage(float depth, float half_length) const {
        const float from = std::max(depth - half_length, 0.0f), to = std::max(depth + half_length, 0.0f);
        float sum = 0.0f;
        for (std::size_t c = 0; c < channels_; ++c)
            sum += std::exp(-extinction_[c] * from) * -std::expm1(-extinction_[c] * (to - from));
        return sum / static_cast<float>(channels_);
    }

  private:
    PhotonPlacement() = default;

    std::array<float, 3> extinction_{};
    std::size_t channels_ = 0;
};

}  // namespace phasetree::tracer
