// Small hills and dales that a surface seems to have because light is scattered as if it had them: its normal is that
// of a surface which is higher by h everywhere, and its place stays as it is. With the gradient ∇h along the surface
// the normal is
//     n' = (n − ∇h)/|n − ∇h|.
// The difference of two heights, the texture's brightness times `height`, is taken over a distance as long as |height|.
// So a step in the texture becomes a slope of 45°, and details that are much smaller than the height are left out.
//
// Light that leaves the hill in a direction into the surface meets the surface again, and is scattered once more: no
// energy is lost.
//
// Reference: Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH 1978.
#pragma once

#include <glm/vec3.hpp>

#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

struct Bump {
    Texture texture = ConstantTexture{};
    float height = 0.0f;  ///< in the unit of length; how much higher white is than black, and lower if it is negative

    /// The unit normal at a place, in the space of textures, for the place's own normal.
    glm::vec3 normal_at(const TexturePoint& place) const;
};

/// A bumped normal that is seen along a ray: where it would face away from the ray it is turned towards it until they
/// are nearly perpendicular, because nothing is seen of a hill's far side. Both normals are of unit length; `flat` is
/// that of the surface, and faces the ray.
glm::vec3 turned_to_ray(const glm::vec3& bumped, const glm::vec3& flat, const glm::vec3& ray_direction);

}  // namespace phasetree::tracer
