// The noise of a pixel: the standard error of its mean luminance, estimated from its samples. It decides where a render
// may stop early (render/noise_limit.hpp).
#pragma once

#include <cmath>

#include "film/contract.hpp"
#include "film/sums/mean_and_variance.hpp"
#include "image/luminance.hpp"

namespace phasetree::tracer {

/// The estimate is for independent samples. The sampler stratifies a pixel's samples, so the true error is smaller.
struct NoisePlane {
    using Sum = MeanAndVariance;
    static constexpr std::string_view name = "noise";
    static constexpr bool by_default = false;
    explicit NoisePlane(const SceneNames&) {}

    std::vector<std::string> channels() const { return {"noise.Y"}; }
    std::size_t sums() const { return 1; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults&) const {
        FilmFaults uncounted;  // already counted by the picture
        sums[0].add(luminance(sample.radiance), uncounted);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        values[0] = static_cast<float>(std::sqrt(sums[0].variance_of_mean(samples)));
    }
};

}  // namespace phasetree::tracer
