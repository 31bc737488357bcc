// Applies mixtures, bumps, normal maps and grain to a surface that a ray has met: which material is there, the shading
// normal, and the direction of strokes. Normals and strokes are given in the object's texture space, and transformed to
// scene space here.
#pragma once

#include <glm/glm.hpp>

#include "scene/transform.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// The identity, for textures that are defined in scene space.
struct AlreadyInScene {
    glm::vec3 normal(const glm::vec3& n) const { return n; }
    glm::vec3 direction(const glm::vec3& d) const { return d; }
};

/// Transforms normals and directions from object space to scene space.
struct FromCopyToScene {
    const Transform& to_object;  ///< the copy's transform, from scene to object space

    glm::vec3 normal(const glm::vec3& n) const { return glm::vec3(glm::normalize(glm::dvec3(n) * to_object.matrix)); }
    glm::vec3 direction(const glm::vec3& d) const { return glm::vec3(glm::inverse(to_object.matrix) * glm::dvec3(d)); }
};

/// Sets the optics of a surface to those that a mixture has at its point. The other members must be set.
inline void choose_of_mixture(Surface& surface) {
    const Interface& all = surface.optics.get();
    surface.is_partly_rough = all.mixes_rough(surface.place);
    surface.optics = all.chosen_at(surface.place);
}

/// Turns the normal and sets along_grain of a surface whose other members are set. `space` transforms normals and
/// directions to scene space.
template <class Space>
void add_bumps_and_grain(Surface& surface, const glm::vec3& ray_direction, const Space& space) {
    const Interface& optics = surface.optics.get();
    if (const NormalPerturbation* perturbation = optics.perturbation())
        surface.normal = turned_to_ray(space.normal(perturbed_normal(*perturbation, surface.place)),
                                       surface.geometric_normal, ray_direction);
    if (const Grain* grain = optics.grain()) surface.along_grain = space.direction(grain->direction_at(surface.place));
}

}  // namespace phasetree::tracer
