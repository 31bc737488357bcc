// Finds where a line through a ball around an emissive part (lights/emissive_part.hpp) leaves an emissive surface.
//
// A photon from such a ball travels on a line through the ball and starts where that line leaves a surface. If the line
// leaves several surfaces, the photon starts at the last one. So a surface emits it only if neither an opaque surface
// nor a lamp is between there and where the line leaves the ball. Clear boundaries are allowed. They will refract the
// photon, but the line on which it is sampled goes straight through them.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lights/bounding_sphere.hpp"
#include "scene/scene.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// What a straight line through clear boundaries meets.
struct FreeLine {
    std::optional<Surface> opaque{};  ///< the first opaque surface, unless a lamp is in front of it
    float free = 0;                   ///< distance to that surface or lamp
};

/// Returns the surface from which a ball emits a photon on the line through a point, and the distance from the surface
/// to where the line leaves the ball. The direction has unit length; the time is a share of the shutter interval. The
/// surface may be one that does not emit. There is none if the line meets nothing opaque in the ball, if a lamp is in
/// front of the surface, or if the line leaves the ball in an opaque phase.
FreeLine last_surface_in(const BoundingSphere& ball, const World& world, const Scene& scene, const glm::vec3& point,
                         const glm::vec3& direction, float time);

/// The distance over which the line that leaves a surface is free of lamps and opaque surfaces; infinity if all of it
/// is free. The direction has unit length and is on the side from which the surface was met.
float free_distance(const Surface& from, const glm::vec3& direction, const World& world, const Scene& scene);

/// The distance along a line from its origin inside a ball to where it leaves the ball; nullopt if the origin is
/// outside.
std::optional<float> distance_to_leave(const BoundingSphere& ball, const glm::vec3& origin, const glm::vec3& direction);

}  // namespace phasetree::tracer
