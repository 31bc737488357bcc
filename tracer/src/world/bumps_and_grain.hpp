// What bumps and strokes make of a surface that a ray has met: how its shading normal turns, and where its strokes run.
// Both are known in the space of textures, that of what was met.
#pragma once

#include <glm/glm.hpp>

#include "scene/transform.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// Of what stands in the scene's own space.
struct InSceneSpace {
    glm::vec3 normal(const glm::vec3& n) const { return n; }
    glm::vec3 direction(const glm::vec3& d) const { return d; }
};

/// Of a copy of an object.
struct InSpaceOfCopy {
    const Transform& to_object;  ///< from the scene

    glm::vec3 normal(const glm::vec3& n) const { return glm::vec3(glm::normalize(glm::dvec3(n) * to_object.matrix)); }
    glm::vec3 direction(const glm::vec3& d) const { return glm::vec3(glm::inverse(to_object.matrix) * glm::dvec3(d)); }
};

/// The rest of the surface is complete. `space` takes normals and directions to the scene.
template <class Space>
void add_bumps_and_grain(Surface& surface, const glm::vec3& ray_direction, const Space& space) {
    const Interface& optics = surface.optics.get();
    if (const Bump* bump = optics.bump())
        surface.normal =
            turned_to_ray(space.normal(bump->normal_at(surface.place)), surface.geometric_normal, ray_direction);
    if (const Grain* grain = optics.grain()) surface.along_grain = space.direction(grain->direction_at(surface.place));
}

}  // namespace phasetree::tracer
