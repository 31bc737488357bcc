// Bump mapping: light is scattered as if the surface were moved by h along its normal, and nothing is moved. Here h is
// the texture's brightness times `height`. With the gradient ∇h along the surface the normal is
//     n' = (n − ∇h)/|n − ∇h|.
// Each of the gradient's two components is a difference of heights over a distance as long as |height|. So a step in
// the texture becomes a slope of 45° where it runs along one of the two directions, and of up to 55° where it runs
// between them, and details that are much smaller than the height are left out. A mesh is bumped towards the side from
// which it is seen.
//
// The normal may send light into the surface. A path then meets the surface once more at its next step, and is
// scattered again, so no energy is lost.
//
// Reference: Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH 1978.
#pragma once

#include <glm/vec3.hpp>

#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

struct Bump {
    Texture texture = ConstantTexture{};
    float height = 0.0f;  ///< height of white above black, in the unit of length; negative: white is lower

    /// The bumped normal at a place, of unit length, in the space of textures; place.normal is the surface's own.
    glm::vec3 normal_at(const TexturePoint& place) const;
};

/// The bumped normal for a ray that meets the surface. Nothing is seen of a hill's far side, so a normal that faces
/// away from the ray, or nearly, is turned until it faces the ray. Both normals are of unit length; `flat` is the
/// surface's own and faces the ray. Where normals are turned light is not scattered the same both ways: paths and
/// photons, which come from either side, then differ a little.
glm::vec3 turned_to_ray(const glm::vec3& bumped, const glm::vec3& flat, const glm::vec3& ray_direction);

}  // namespace phasetree::tracer
