// The picture, and the features for denoising (denoise/denoise.hpp), from about half of a pixel's samples. The sum over
// all samples minus the sum over this half is the sum over the other half. The difference of the halves measures the
// noise of both, and each can be filtered with weights that are independent of its own noise.
//
// Samples are divided into blocks of four, because each aligned block of Sobol' samples is spread evenly over the pixel
// (sampling/sobol.hpp), and so both halves are, too. Alternating samples would not work: consecutive samples complement
// one another, so the halves would differ by more than their noise.
#pragma once

#include <array>

#include "film/contract.hpp"
#include "film/path_record.hpp"
#include "film/sums/weighted_mean.hpp"

namespace phasetree::tracer {

struct HalfOfSamplesPlane {
    static constexpr std::size_t values = 15;
    /// All samples of a block of this size are in the same half.
    static constexpr std::uint32_t block = 4;

    using Sum = WeightedMean<values>;
    static constexpr std::string_view name = "half";
    static constexpr bool by_default = false;
    explicit HalfOfSamplesPlane(const SceneNames&) {}

    /// The last one is the number of samples in this half.
    static constexpr std::array<std::string_view, values + 1> channel_names{"half.R",
                                                                            "half.G",
                                                                            "half.B",  //
                                                                            "half_albedo.R",
                                                                            "half_albedo.G",
                                                                            "half_albedo.B",  //
                                                                            "half_normal.X",
                                                                            "half_normal.Y",
                                                                            "half_normal.Z",  //
                                                                            "half_albedo_behind.R",
                                                                            "half_albedo_behind.G",
                                                                            "half_albedo_behind.B",  //
                                                                            "half_normal_behind.X",
                                                                            "half_normal_behind.Y",
                                                                            "half_normal_behind.Z",  //
                                                                            "half_samples.X"};

    static bool contains(std::uint32_t number) { return number / block % 2 == 0; }

    std::vector<std::string> channels() const { return {channel_names.begin(), channel_names.end()}; }
    std::size_t sums() const { return 1; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults&) const {
        if (!contains(sample.number)) return;
        FilmFaults uncounted;  // already counted by the picture
        sums[0].add(values_of(sample), 1.0f, uncounted);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t, std::span<float> resolved) const {
        const std::array<float, values> means = sums[0].mean(0);
        std::copy(means.begin(), means.end(), resolved.begin());
        resolved[values] = static_cast<float>(sums[0].weight());
    }

  private:
    static std::array<float, values> values_of(const FilmSample& sample) {
        std::array<float, values> all{};
        std::size_t i = 0;
        const auto put = [&](const glm::vec3& v) {
            for (int c = 0; c < 3; ++c) all[i++] = v[c];
        };
        put(sample.radiance);
        if (!sample.record) return all;
        const PathRecord& record = *sample.record;
        put(record.first ? record.first->albedo : glm::vec3(0));
        put(record.first ? record.first->normal : glm::vec3(0));
        put(record.behind ? record.behind->albedo : glm::vec3(0));
        put(record.behind ? record.weight * record.behind->normal : glm::vec3(0));
        return all;
    }
};

}  // namespace phasetree::tracer
