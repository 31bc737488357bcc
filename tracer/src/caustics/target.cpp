#include "caustics/target.hpp"

#include <cmath>

namespace phasetree::tracer {

namespace {

// Lines almost parallel to the plane have no useful density in it.
constexpr float least_cosine = 0.05f;

}  // namespace

PhotonTarget::PhotonTarget(const glm::vec3& centre, const glm::vec3& normal, float half_side)
    : centre_(centre), frame_(normal), half_side_(half_side), choice_(cells_a_side * cells_a_side) {}

PhotonTarget::Aim PhotonTarget::sample(float u_cell, const glm::vec2& u) const {
    const std::size_t cell = choice_.sample(static_cast<double>(u_cell));
    const auto column = static_cast<float>(cell % cells_a_side), row = static_cast<float>(cell / cells_a_side);
    const float scale = 2.0f * half_side_ / static_cast<float>(cells_a_side);
    const glm::vec3 local((column + u.x) * scale - half_side_, (row + u.y) * scale - half_side_, 0.0f);
    return {centre_ + frame_.to_world(local), cell};
}

PhotonTarget::Crossing PhotonTarget::crossing(const glm::vec3& origin, const glm::vec3& direction) const {
    const float cosine = glm::dot(direction, frame_.normal());
    if (!(std::abs(cosine) > least_cosine)) return {0.0f, 0.0f};
    const float distance = glm::dot(centre_ - origin, frame_.normal()) / cosine;
    const glm::vec3 local = frame_.to_local(origin + distance * direction - centre_);
    const float scale = static_cast<float>(cells_a_side) / (2.0f * half_side_);
    const float x = (local.x + half_side_) * scale, y = (local.y + half_side_) * scale;
    constexpr auto end = static_cast<float>(cells_a_side);
    if (!(x >= 0.0f && x < end && y >= 0.0f && y < end)) return {0.0f, distance};
    const auto cell = static_cast<std::size_t>(static_cast<int>(y) * cells_a_side + static_cast<int>(x));
    const auto share = static_cast<float>(choice_.probability(cell));
    return {share * (scale * scale) / std::abs(cosine), distance};
}

}  // namespace phasetree::tracer
