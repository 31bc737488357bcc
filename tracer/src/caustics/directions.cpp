#include "caustics/directions.hpp"

#include <algorithm>
#include <cmath>

#include "phasetree/math/portable.hpp"
#include "sampling/warps.hpp"

namespace phasetree::tracer {

PhotonDirections::Sample PhotonDirections::sample(float u_bin, const glm::vec2& u) const {
    const std::size_t bin = choice_.sample(static_cast<double>(u_bin));
    const auto side = static_cast<std::size_t>(bins_per_side_);
    const auto column = static_cast<float>(bin % side), row = static_cast<float>(bin / side);
    const float scale = 1.0f / static_cast<float>(bins_per_side_);
    const float z = 1.0f - 2.0f * (row + u.y) * scale;
    const float sine = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float azimuth = 2.0f * pi * (column + u.x) * scale;
    return {glm::normalize(glm::vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z)), bin};
}

float PhotonDirections::density(const glm::vec3& direction) const {
    const auto side = static_cast<float>(bins_per_side_);
    float turns = portable::atan2(direction.y, direction.x) / (2.0f * pi);
    if (turns < 0.0f) turns += 1.0f;
    const auto bin_of = [&](float share) { return std::clamp(static_cast<int>(share * side), 0, bins_per_side_ - 1); };
    const int row = bin_of(0.5f * (1.0f - direction.z)), column = bin_of(turns);
    const auto bin = static_cast<std::size_t>(row * bins_per_side_ + column);
    return static_cast<float>(choice_.probability(bin) * static_cast<double>(bins())) / (4.0f * pi);
}

}  // namespace phasetree::tracer
