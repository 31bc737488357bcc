#include "lights/zonal_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lights/lat_long.hpp"
#include "sampling/inversion.hpp"

namespace phasetree::tracer {

ZonalDistribution::ZonalDistribution(std::span<const double> means)
    : cumulative_(means.size() + 1), density_(means.size()) {
    const double solid_angle = 4.0 * std::numbers::pi / static_cast<double>(means.size());
    integral_ = static_cast<float>(accumulate(means, cumulative_) * solid_angle);
    // Computed from the stored, rounded sums, so that they are exactly the probabilities with which sample() chooses.
    for (std::size_t i = 0; i < density_.size(); ++i)
        density_[i] = static_cast<float>((cumulative_[i + 1] - cumulative_[i]) / solid_angle);
}

std::optional<DirectionSample> ZonalDistribution::sample(const glm::vec2& u) const {
    if (!(integral_ > 0.0f)) return std::nullopt;
    const Inverse zone = invert(cumulative_, u.y);
    const double place = static_cast<double>(zone.index) + static_cast<double>(zone.position);
    const double z = 2.0 * place / static_cast<double>(density_.size()) - 1.0;
    const double azimuth = 2.0 * std::numbers::pi * (static_cast<double>(u.x) - 0.5);
    return DirectionSample{direction_of(azimuth, z), density_[zone.index]};
}

float ZonalDistribution::pdf(const glm::vec3& direction) const {
    const auto zones = static_cast<float>(density_.size());
    const float zone = std::clamp(0.5f * (direction.z + 1.0f) * zones, 0.0f, zones - 1.0f);
    return density_[static_cast<std::size_t>(zone)];
}

}  // namespace phasetree::tracer
