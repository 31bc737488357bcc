#include "caustics/aim.hpp"

namespace phasetree::tracer {

namespace {

// A lamp is close by if its distance to the centre of the object is less than this many radii of the object. Take a
// point at least that far away, and the plane through the sphere's centre that faces it. All lines from the point that
// meet the sphere cross this plane within 1.6/√(1.6² − 1) = 1.28 radii of the centre.
constexpr float near_in_radii = 1.6f;
constexpr float target_in_radii = 1.3f;
// A lamp is small if its radius is less than this share of the object's.
constexpr float small_in_radii = 0.125f;

std::variant<PhotonTarget, PhotonDirections> chooser_of(const BoundingSphere& lamp, const BoundingSphere& object) {
    const glm::vec3 towards = object.centre - lamp.centre;
    const float distance = glm::length(towards);
    if (!(distance > near_in_radii * object.radius) && lamp.radius < small_in_radii * object.radius)
        return PhotonDirections(PhotonTarget::bins_per_side);
    const glm::vec3 normal = distance > 0.0f ? towards / distance : glm::vec3(0.0f, 0.0f, 1.0f);
    return PhotonTarget(object.centre, normal, target_in_radii * object.radius);
}

}  // namespace

PhotonAim::PhotonAim(const BoundingSphere& lamp, const BoundingSphere& object)
    : chooser_(chooser_of(lamp, object)), distance_without_square_(2.0f * object.radius) {}

std::size_t PhotonAim::bins() const {
    return std::visit([](const auto& chooser) { return chooser.bins(); }, chooser_);
}

void PhotonAim::set_weights(std::span<const double> weights) {
    std::visit([&](auto& chooser) { chooser.set_weights(weights); }, chooser_);
}

std::optional<PhotonAim::Sample> PhotonAim::sample(const glm::vec3& from, float u_bin, const glm::vec2& u) const {
    if (const auto* directions = std::get_if<PhotonDirections>(&chooser_)) {
        const auto [direction, bin] = directions->sample(u_bin, u);
        return Sample{direction, distance_without_square_, bin};
    }
    const auto [point, bin] = std::get<PhotonTarget>(chooser_).sample(u_bin, u);
    const float distance = glm::length(point - from);
    if (!(distance > 0.0f)) return std::nullopt;
    return Sample{(point - from) / distance, distance, bin};
}

float PhotonAim::density(const glm::vec3& from, const glm::vec3& direction) const {
    if (const auto* directions = std::get_if<PhotonDirections>(&chooser_)) return directions->density(direction);
    const PhotonTarget::Crossing crossing = std::get<PhotonTarget>(chooser_).crossing(from, direction);
    return crossing.distance > 0.0f ? crossing.density * crossing.distance * crossing.distance : 0.0f;
}

}  // namespace phasetree::tracer
