// The distance that camera rays travel in each phase, up to the first surface that is not perfectly smooth: the mean
// over the samples, weighted as if each were reflected or refracted with the probabilities of Fresnel's equations
// (path_record.hpp).
#pragma once

#include "film/channel_name.hpp"
#include "film/recorded_plane.hpp"

namespace phasetree::tracer {

/// A channel length_PHASE.X for each phase, including the vacuum.
class LengthPlane {
  public:
    using Sum = ValueSum;
    static constexpr std::string_view name = "length";
    static constexpr bool by_default = false;
    explicit LengthPlane(const SceneNames& scene_names) : phases_(scene_names.phases) {}

    std::vector<std::string> channels() const { return channel_names("length_", phases_, ".X"); }
    std::size_t sums() const { return phases_.size(); }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults& faults) const {
        if (!sample.record) return;
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i].add(static_cast<double>(sample.record->weight * sample.record->lengths[i]), faults);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        for (std::size_t i = 0; i < sums.size(); ++i) values[i] = static_cast<float>(sums[i].value() / samples);
    }

  private:
    std::vector<std::string> phases_;
};

}  // namespace phasetree::tracer
