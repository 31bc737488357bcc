// Where a line through a ball around a glowing part (lights/glowing_part.hpp) leaves a glowing surface.
//
// A photon that such a ball sends flies on a line through the ball, and starts where that line leaves a surface. Where
// it leaves several, the photon starts at the last of them. So a surface sends it only if neither an opaque surface nor
// a lamp is between there and the end of the line in the ball. Clear boundaries may be there. They will bend the
// photon, but the line that it is sampled on goes straight through them.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lights/bounding_sphere.hpp"
#include "scene/scene.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

/// What a straight line meets that goes through clear boundaries.
struct FreeLine {
    std::optional<Surface> opaque{};  ///< the first opaque surface, if no lamp is before it
    float free = 0;                   ///< the distance to there, or to the lamp
};

/// The surface from which a ball sends a photon on the line through a point in a direction of unit length, at a share
/// of the time in which the shutter is open, and how far it is from the end of the line in the ball. The surface may be
/// one that does not glow. There is none if nothing opaque is on the line in the ball, if a lamp is before it, or if
/// the line leaves the ball in an opaque phase.
FreeLine last_surface_in(const BoundingSphere& ball, const World& world, const Scene& scene, const glm::vec3& point,
                         const glm::vec3& direction, float time);

/// How far the line that leaves a surface in a direction, of unit length and on the side from which the surface was
/// met, is free of lamps and of all that is opaque; infinity if it is all free.
float free_distance(const Surface& from, const glm::vec3& direction, const World& world, const Scene& scene);

/// The distance along a line to where it leaves a ball that its origin is in; nothing if it is not in it.
std::optional<float> distance_to_leave(const BoundingSphere& ball, const glm::vec3& origin, const glm::vec3& direction);

}  // namespace phasetree::tracer
