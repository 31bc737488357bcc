#include "caustics/aim.hpp"

namespace phasetree::tracer {

namespace {

// A lamp is close by if its distance to the centre of the object is less than this many radii of the object. From a
// point at least that far away, all lines that meet the object's sphere pass a plane through its centre within
// 1.6/√(1.6² − 1) = 1.28 radii.
constexpr float near_in_radii = 1.6f;
constexpr float target_in_radii = 1.3f;
// A lamp is small if its radius is less than this share of the object's.
constexpr float small_in_radii = 0.125f;

std::variant<PhotonTarget, PhotonDirections> target_from(const BoundingSphere& lamp, const BoundingSphere& object) {
    const glm::vec3 towards = object.centre - lamp.centre;
    const float distance = glm::length(towards);
    if (!(distance > near_in_radii * object.radius) && lamp.radius < small_in_radii * object.radius)
        return PhotonDirections(PhotonTarget::cells_a_side);
    const glm::vec3 normal = distance > 0.0f ? towards / distance : glm::vec3(0.0f, 0.0f, 1.0f);
    return PhotonTarget(object.centre, normal, target_in_radii * object.radius);
}

}  // namespace

PhotonAim::PhotonAim(const BoundingSphere& lamp, const BoundingSphere& object)
    : to_(target_from(lamp, object)), beyond_(2.0f * object.radius) {}

std::size_t PhotonAim::cells() const {
    return std::visit([](const auto& to) { return to.cells(); }, to_);
}

void PhotonAim::set_weights(std::span<const double> weights) {
    std::visit([&](auto& to) { to.set_weights(weights); }, to_);
}

std::optional<PhotonAim::Aimed> PhotonAim::sample(const glm::vec3& from, float u_cell, const glm::vec2& u) const {
    if (const auto* directions = std::get_if<PhotonDirections>(&to_)) {
        const auto [direction, cell] = directions->sample(u_cell, u);
        return Aimed{direction, beyond_, cell};
    }
    const auto [point, cell] = std::get<PhotonTarget>(to_).sample(u_cell, u);
    const float distance = glm::length(point - from);
    if (!(distance > 0.0f)) return std::nullopt;
    return Aimed{(point - from) / distance, distance, cell};
}

float PhotonAim::density(const glm::vec3& from, const glm::vec3& direction) const {
    if (const auto* directions = std::get_if<PhotonDirections>(&to_)) return directions->density(direction);
    const PhotonTarget::Crossing crossing = std::get<PhotonTarget>(to_).crossing(from, direction);
    return crossing.distance > 0.0f ? crossing.density * crossing.distance * crossing.distance : 0.0f;
}

}  // namespace phasetree::tracer
