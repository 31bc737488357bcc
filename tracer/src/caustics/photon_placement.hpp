// Where a photon is stored on its line through a scattering medium, and for which points of the line it counts.
//
// One stored point represents a whole line, at the depth t behind the boundary where the line enters. It counts for all
// points of the line that are at most h away from it. The point is sampled like a free flight that starts at the depth
// −h, in one of the n colour channels that scatter, chosen uniformly,
//     p(t) = Σ σ_c exp(−σ_c (t + h))/n   for t ≥ −h,
// with the extinction σ_c of the channel. The photon itself is not scattered there; it continues to the end of the
// medium. So a point at the depth t is covered with the probability
//     F(t) = ∫ p over [t − h, t + h] = Σ (exp(−σ_c max(t, 0)) − exp(−σ_c (t + 2h)))/n,
// and the contribution of the line there, its power times the transmittance T(t), is multiplied by 1/F(t). Flights
// start before the boundary so that F is not small at the boundary, where a few photons would otherwise get very high
// weights. Channels that do not scatter need no points, because nothing that arrives in them is scattered. But the
// extinction at a single wavelength mixes those of all channels. If a channel that does not scatter is far clearer than
// the others, a few photons of a single wavelength do get high weights.
//
// In a medium with varying density, the depth that light reaches is unknown beforehand. Points are then sampled as in
// six homogeneous media, instead of channels. Their extinctions are the greatest one of the medium, σ̄, and σ̄/4,
// σ̄/16, … σ̄/1024. T is estimated by the medium, on the way back from the point.
//
// Across the line, photons are gathered in a disc, like those on a surface; along it there is no blur. If a line meets
// the boundary obliquely, it may meet the disc around a point of the medium before it enters. The depth is then
// negative, which is why max(t, 0) appears above, and T is 1.
//
// This is a short beam of Jarosz, Nowrouzezahrai, Sadeghi & Jensen, A Comprehensive Theory of Volumetric Radiance
// Estimation Using Photon Points and Beams, TOG 30(1), 2011, gathered at a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "media/medium.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

class PhotonPlacement {
  public:
    /// `half_length` is the h of the photons' pass (PhotonMap::half_length). nullopt for a medium that gathers no
    /// photons.
    static std::optional<PhotonPlacement> in(const Medium& medium, float half_length) {
        PhotonPlacement placement(half_length);
        if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium))
            placement.sample_channels_of(homogeneous->coefficients());
        else if (const auto* varying = std::get_if<VaryingMedium>(&medium))
            placement.sample_densities_of(varying->coefficients());
        if (placement.channels_ == 0) return std::nullopt;
        return placement;
    }

    /// Samples a depth, with u in [0, 1).
    float sample(float u) const {
        const float at = u * static_cast<float>(channels_);
        const std::size_t channel = std::min(static_cast<std::size_t>(at), channels_ - 1);
        // Less than 1 even after rounding, so that the flight ends.
        const float rest = std::min(at - static_cast<float>(channel), 0x1.fffffep-1f);
        return -portable::log1p(-rest) / extinction_[channel] - half_length_;
    }
    /// F(depth). It is 0 where it underflows a float.
    float coverage(float depth) const {
        const float from = std::max(depth, 0.0f), to = std::max(depth + 2.0f * half_length_, 0.0f);
        float sum = 0.0f;
        for (std::size_t c = 0; c < channels_; ++c)
            sum += std::exp(-extinction_[c] * from) * -portable::expm1(-extinction_[c] * (to - from));
        return sum / static_cast<float>(channels_);
    }

  private:
    explicit PhotonPlacement(float half_length) : half_length_(half_length) {}

    void sample_channels_of(const ScatteringCoefficients& coefficients) {
        const glm::vec3 extinction = coefficients.extinction();
        for (int c = 0; c < 3; ++c)
            if (coefficients.scattering[c] > 0.0f) extinction_[channels_++] = extinction[c];
        // If all channels are equal, one is enough.
        if (std::ranges::all_of(std::span(extinction_).first(channels_), [&](float e) { return e == extinction_[0]; }))
            channels_ = std::min(channels_, std::size_t{1});
    }
    void sample_densities_of(const ScatteringCoefficients& coefficients) {
        if (!coefficients.scatters()) return;
        const glm::vec3 extinction = coefficients.extinction();
        float densest = std::max({extinction.x, extinction.y, extinction.z});
        for (float& extinction_of_one : extinction_) {
            extinction_of_one = densest;
            densest /= 4;
        }
        channels_ = extinction_.size();
    }

    float half_length_;
    std::array<float, 6> extinction_{};  ///< of the channels that scatter, or of several densities
    std::size_t channels_ = 0;
};

}  // namespace phasetree::tracer
