// Parts of the picture by the origin of their light (path_record.hpp): direct and indirect light, and one part per
// group of lights. Direct plus indirect light, and also the sum over all groups, is the picture, up to rounding.
#pragma once

#include <array>

#include "film/channel_name.hpp"
#include "film/recorded_plane.hpp"

namespace phasetree::tracer {

struct Direct {
    static constexpr std::string_view name = "direct";
    static constexpr std::array<std::string_view, 3> channels{"direct.R", "direct.G", "direct.B"};
    static std::optional<std::array<float, 3>> of(const FilmSample& s) {
        if (!s.record) return std::nullopt;
        return components(s.record->direct);
    }
};
struct Indirect {
    static constexpr std::string_view name = "indirect";
    static constexpr std::array<std::string_view, 3> channels{"indirect.R", "indirect.G", "indirect.B"};
    static std::optional<std::array<float, 3>> of(const FilmSample& s) {
        if (!s.record) return std::nullopt;
        return components(s.record->indirect);
    }
};
using DirectPlane = MeanPlane<Direct>;
using IndirectPlane = MeanPlane<Indirect>;

/// Channels light_GROUP.R, .G and .B for each group.
class LightGroupsPlane {
  public:
    using Sum = ValueSum;
    static constexpr std::string_view name = "lights";
    static constexpr bool by_default = false;
    explicit LightGroupsPlane(const SceneNames& scene_names) : groups_(scene_names.groups) {}

    std::vector<std::string> channels() const {
        std::vector<std::string> all;
        for (const std::string& layer : channel_names("light_", groups_, ""))
            for (const char* channel : {".R", ".G", ".B"}) all.push_back(layer + channel);
        return all;
    }
    std::size_t sums() const { return 3 * groups_.size(); }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults& faults) const {
        if (!sample.record) return;
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i].add(static_cast<double>(sample.record->groups[i / 3][static_cast<int>(i % 3)]), faults);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        for (std::size_t i = 0; i < sums.size(); ++i) values[i] = static_cast<float>(sums[i].value() / samples);
    }

  private:
    std::vector<std::string> groups_;
};

}  // namespace phasetree::tracer
