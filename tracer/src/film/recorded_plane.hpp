// Planes of the data in a PathRecord (path_record.hpp): one template for each way of combining the samples of a pixel
// into one value. `What` has a name, channels, and of(sample), which returns nullopt if the sample has no value.
#pragma once

#include <array>
#include <optional>

#include "film/contract.hpp"
#include "film/path_record.hpp"
#include "film/sums/first_value.hpp"
#include "film/sums/fixed_sum.hpp"
#include "film/sums/weighted_mean.hpp"

namespace phasetree::tracer {

inline std::array<float, 3> components(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

template <class What>
struct RecordedPlane {
    static constexpr std::string_view name = What::name;
    static constexpr bool by_default = false;
    static constexpr std::size_t size = What::channels.size();

    std::vector<std::string> channels() const { return {What::channels.begin(), What::channels.end()}; }
};

/// The mean over all samples, in which samples without a value count as 0: smooth along edges, as filters and denoisers
/// require.
template <class What>
struct MeanPlane : RecordedPlane<What> {
    using Sum = ValueSum;
    explicit MeanPlane(const SceneNames&) {}

    std::size_t sums() const { return What::channels.size(); }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults& faults) const {
        if (const auto values = What::of(sample))
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i].add(static_cast<double>((*values)[i]), faults);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        for (std::size_t i = 0; i < sums.size(); ++i) values[i] = static_cast<float>(sums[i].value() / samples);
    }
};

/// The mean over the samples with a value (those that met something), weighted by What::weight(sample); What::otherwise
/// if there are none.
template <class What>
struct MeanOfHitsPlane : RecordedPlane<What> {
    using Sum = WeightedMean<What::channels.size()>;
    explicit MeanOfHitsPlane(const SceneNames&) {}

    std::size_t sums() const { return 1; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults& faults) const {
        if (const auto values = What::of(sample)) sums[0].add(*values, What::weight(sample), faults);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t, std::span<float> values) const {
        const auto means = sums[0].mean(What::otherwise);
        std::copy(means.begin(), means.end(), values.begin());
    }
};

/// The value of the first sample that has one: for values that have no mean, such as IDs. These planes have hard edges;
/// use Cryptomatte for mattes with soft ones.
template <class What>
struct FirstSamplePlane : RecordedPlane<What> {
    using Sum = FirstValue<What::channels.size()>;
    explicit FirstSamplePlane(const SceneNames&) {}

    std::size_t sums() const { return 1; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults&) const {
        if (const auto values = What::of(sample)) sums[0].add(*values, sample.number);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t, std::span<float> values) const {
        const auto first = sums[0].values(What::otherwise);
        std::copy(first.begin(), first.end(), values.begin());
    }
};

}  // namespace phasetree::tracer
