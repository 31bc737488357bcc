// What mixtures, bumps, maps of normals and strokes make of a surface that a ray has met: which material is there, how
// its shading normal turns, and where its strokes run. Normals and strokes are given in the space in which the object's
// textures are, and are taken to the scene's here.
#pragma once

#include <glm/glm.hpp>

#include "scene/transform.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// Leaves directions alone: the space of the textures of what was met is the scene's own.
struct AlreadyInScene {
    glm::vec3 normal(const glm::vec3& n) const { return n; }
    glm::vec3 direction(const glm::vec3& d) const { return d; }
};

/// Takes normals and directions from the object's space to the scene's.
struct FromCopyToScene {
    const Transform& to_object;  ///< the copy's transform, from the scene to the object

    glm::vec3 normal(const glm::vec3& n) const { return glm::vec3(glm::normalize(glm::dvec3(n) * to_object.matrix)); }
    glm::vec3 direction(const glm::vec3& d) const { return glm::vec3(glm::inverse(to_object.matrix) * glm::dvec3(d)); }
};

/// Gives a surface whose other members are set the optics of what a mixture has at its place.
inline void choose_of_mixture(Surface& surface) {
    const Interface& all = surface.optics.get();
    surface.is_partly_rough = all.mixes_rough(surface.place);
    surface.optics = all.chosen_at(surface.place);
}

/// Turns the normal and sets along_grain of a surface whose other members are set. `space` takes normals and directions
/// to the scene's space.
template <class Space>
void add_bumps_and_grain(Surface& surface, const glm::vec3& ray_direction, const Space& space) {
    const Interface& optics = surface.optics.get();
    if (const NormalPerturbation* perturbation = optics.perturbation())
        surface.normal = turned_to_ray(space.normal(perturbed_normal(*perturbation, surface.place)),
                                       surface.geometric_normal, ray_direction);
    if (const Grain* grain = optics.grain()) surface.along_grain = space.direction(grain->direction_at(surface.place));
}

}  // namespace phasetree::tracer
