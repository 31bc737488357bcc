// Bump mapping: light is scattered as if the surface were displaced by h along its normal, without moving geometry. h
// is the texture's brightness times `height`. With the gradient ∇h along the surface, the normal is
//     n' = (n − ∇h)/|n − ∇h|.
// Each of the gradient's two components is a difference of heights over a distance of |height|. So a step in the
// texture becomes a slope of 45° where it runs along one of the two directions, and of up to 55° where it runs between
// them. Details much smaller than the height are lost. A mesh is bumped towards the side from which it is seen.
//
// The normal may send light into the surface, or refract it back to where it came from. A path then meets the surface
// again at its next step and is scattered again, so no energy is lost. Its phase is that of the side on which it
// starts, so no light leaks through glass.
//
// Reference: Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH 1978.
#pragma once

#include <glm/vec3.hpp>

#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

struct Bump {
    Texture texture = ConstantTexture{};
    float height = 0.0f;  ///< height of white above black, in the unit of length; negative: white is lower

    /// The bumped normal at a point, of unit length, in texture space; place.normal is the surface's own.
    glm::vec3 normal_at(const TexturePoint& place) const;
};

/// The bumped normal for a ray that meets the surface. The far side of a bump is hidden, so a normal that faces away
/// from the ray, or nearly so, is turned until it faces the ray. Both normals have unit length; `flat` is the surface's
/// own and faces the ray. Where normals are turned, scattering is not reciprocal: paths and photons, which come from
/// opposite sides, then differ slightly.
glm::vec3 turned_to_ray(const glm::vec3& bumped, const glm::vec3& flat, const glm::vec3& ray_direction);

}  // namespace phasetree::tracer
