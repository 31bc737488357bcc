// The precision of a pixel: the variance of its mean, estimated from its samples, and their number.
#pragma once

#include "film/contract.hpp"
#include "film/sums/count.hpp"
#include "film/sums/mean_and_variance.hpp"

namespace phasetree::tracer {

/// Assumes independent samples. The sampler stratifies them, so the true variance is smaller.
struct VariancePlane {
    using Sum = MeanAndVariance;
    static constexpr std::string_view name = "variance";
    static constexpr bool by_default = false;
    explicit VariancePlane(const SceneNames&) {}

    std::vector<std::string> channels() const { return {"variance.R", "variance.G", "variance.B"}; }
    std::size_t sums() const { return 3; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults&) const {
        FilmFaults uncounted;  // already counted by the picture
        for (std::size_t c = 0; c < 3; ++c) sums[c].add(sample.radiance[static_cast<int>(c)], uncounted);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        for (std::size_t c = 0; c < 3; ++c) values[c] = static_cast<float>(sums[c].variance_of_mean(samples));
    }
};

/// It stores nothing: the film counts the samples of a pixel anyway.
struct SamplesPlane {
    using Sum = Count;
    static constexpr std::string_view name = "samples";
    static constexpr bool by_default = false;
    explicit SamplesPlane(const SceneNames&) {}

    std::vector<std::string> channels() const { return {"samples.X"}; }
    std::size_t sums() const { return 0; }
    void add(std::span<Sum>, const FilmSample&, FilmFaults&) const {}
    void resolve(std::span<const Sum>, std::uint32_t samples, std::span<float> values) const {
        values[0] = static_cast<float>(samples);
    }
};

}  // namespace phasetree::tracer
