#include "caustics/target.hpp"

#include <cmath>

namespace phasetree::tracer {

namespace {

// Lines almost parallel to the plane have no useful density in it.
constexpr float least_cosine = 0.05f;

}  // namespace

PhotonTarget::PhotonTarget(const glm::vec3& centre, const glm::vec3& normal, float half_side)
    : centre_(centre), frame_(normal), half_side_(half_side), choice_(bins_per_side * bins_per_side) {}

PhotonTarget::Sample PhotonTarget::sample(float u_bin, const glm::vec2& u) const {
    const std::size_t bin = choice_.sample(static_cast<double>(u_bin));
    const auto column = static_cast<float>(bin % bins_per_side), row = static_cast<float>(bin / bins_per_side);
    const float scale = 2.0f * half_side_ / static_cast<float>(bins_per_side);
    const glm::vec3 local((column + u.x) * scale - half_side_, (row + u.y) * scale - half_side_, 0.0f);
    return {centre_ + frame_.to_world(local), bin};
}

PhotonTarget::Crossing PhotonTarget::crossing(const glm::vec3& origin, const glm::vec3& direction) const {
    const float cosine = glm::dot(direction, frame_.normal());
    if (!(std::abs(cosine) > least_cosine)) return {0.0f, 0.0f};
    const float distance = glm::dot(centre_ - origin, frame_.normal()) / cosine;
    const glm::vec3 local = frame_.to_local(origin + distance * direction - centre_);
    const float scale = static_cast<float>(bins_per_side) / (2.0f * half_side_);
    const float x = (local.x + half_side_) * scale, y = (local.y + half_side_) * scale;
    constexpr auto end = static_cast<float>(bins_per_side);
    if (!(x >= 0.0f && x < end && y >= 0.0f && y < end)) return {0.0f, distance};
    const auto bin = static_cast<std::size_t>(static_cast<int>(y) * bins_per_side + static_cast<int>(x));
    const auto share = static_cast<float>(choice_.probability(bin));
    return {share * (scale * scale) / std::abs(cosine), distance};
}

}  // namespace phasetree::tracer
