// Where a photon is kept on its line through a medium that scatters, and for which points of the line it counts.
//
// One place stands for a whole line, at the depth t behind the boundary where the line comes in. The place counts for
// all points of the line that are at most h away from it. It is sampled as a free flight would be that starts at the
// depth −h, in one of the n colour channels that scatter, chosen uniformly,
//     p(t) = Σ σ_c exp(−σ_c (t + h))/n   for t ≥ −h,
// with the extinction σ_c of the channel. The photon itself is not scattered there: it goes on to the medium's end. So
// a point at the depth t is covered with the probability
//     F(t) = ∫ p over [t − h, t + h] = Σ (exp(−σ_c max(t, 0)) − exp(−σ_c (t + 2h)))/n,
// and what the line brings there, its power times the transmittance T(t), counts 1/F(t) times. Flights start before the
// boundary so that F is not small at it, which would make a few places count very often. Channels that do not scatter
// need no places, because nothing of what arrives in them is scattered. A single wavelength is a mixture of channels,
// and where one of them is far clearer and does not scatter, a few places do count often.
//
// Where the density of the medium varies, nobody knows beforehand how deep light gets. Places are then sampled as in
// three homogeneous media, instead of channels: one as dense as the medium can be, σ̄, one of σ̄/4 and one of σ̄/16. T is
// estimated by the medium, on the way back from the point.
//
// Across the line photons are gathered in a disc, as those on a surface are; along it nothing is blurred. Where the
// boundary is oblique to a line, the disc around a point of the medium may be met by the line before it comes in; the
// depth is then negative, which is the reason for max(t, 0) above, and T is 1.
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

namespace phasetree::tracer {

class PhotonPlacement {
  public:
    /// With the h of the photons' pass (PhotonMap::half_length). Nothing for a medium that photons do not light.
    static std::optional<PhotonPlacement> in(const Medium& medium, float half_length) {
        PhotonPlacement placement(half_length);
        if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium))
            placement.sample_channels_of(homogeneous->coefficients());
        else if (const auto* varying = std::get_if<VaryingMedium>(&medium))
            placement.sample_densities_of(varying->coefficients());
        if (placement.channels_ == 0) return std::nullopt;
        return placement;
    }

    /// A depth, with u in [0, 1).
    float sample(float u) const {
        const float at = u * static_cast<float>(channels_);
        const std::size_t channel = std::min(static_cast<std::size_t>(at), channels_ - 1);
        // Less than 1 after rounding, too: the flight ends.
        const float rest = std::min(at - static_cast<float>(channel), 0x1.fffffep-1f);
        return -std::log1p(-rest) / extinction_[channel] - half_length_;
    }
    /// F(depth). It is 0 where it is less than floats hold.
    float coverage(float depth) const {
        const float from = std::max(depth, 0.0f), to = std::max(depth + 2.0f * half_length_, 0.0f);
        float sum = 0.0f;
        for (std::size_t c = 0; c < channels_; ++c)
            sum += std::exp(-extinction_[c] * from) * -std::expm1(-extinction_[c] * (to - from));
        return sum / static_cast<float>(channels_);
    }

  private:
    explicit PhotonPlacement(float half_length) : half_length_(half_length) {}

    void sample_channels_of(const ScatteringCoefficients& coefficients) {
        const glm::vec3 extinction = coefficients.extinction();
        for (int c = 0; c < 3; ++c)
            if (coefficients.scattering[c] > 0.0f) extinction_[channels_++] = extinction[c];
        // Channels that are all alike are one, which is computed once.
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
