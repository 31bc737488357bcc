// Chooses between reflection and refraction at a smooth interface by the light expected from each.
//
// Glass reflects about 4 % of the light. If the reflection shows a lamp a hundred times as bright as what is seen
// through the glass, one sample in 25 carries most of the pixel's light, and the pixel is noisy. Therefore a path is
// reflected with the probability
//     q = (F + F B / (F B + (1 − F) B')) / 2,
// where F is the Fresnel reflectance, and B and B' are the brightness of the lights in the directions of the reflected
// and the refracted path, ignoring occlusion. Emissive surfaces and media are enclosed in balls
// (lights/emissive_part.hpp); for them, B is the luminance of the brightest ball that the direction meets. A reflected
// path has the weight F/q and a refracted path (1 − F)/(1 − q), each at most 2.
//
// The direction of a path in glass is not the direction in which it will see a lamp. The estimate assumes that the path
// leaves the glass through a plane parallel to the interface, which is exact for a pane and nearly right for the wall
// of a bottle. This also accounts for lamps reflected by the far side of a pane.
#pragma once

#include <glm/vec3.hpp>

#include "lights/lights.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// The greatest `u_lobe`. With it, a smooth interface refracts unless reflection is total; with 0, it reflects.
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

struct InterfaceChoice {
    float u_lobe;                    ///< argument of Bsdf::sample(), which then takes the chosen branch
    float probability_over_fresnel;  ///< q/F or (1 − q)/(1 − F); divide the weight of that sample by it
};

/// `bsdf` is that of `surface`, which is smooth and clear on both sides. `wo` is the direction of the outgoing light,
/// in the frame. `u` is in [0, 1). Returns {u, 1}, which leaves the choice to the Fresnel reflectance, if reflection is
/// total or if no light is seen in either direction.
InterfaceChoice chosen_by_lights(const Scene& scene, const Surface& surface, const Bsdf& bsdf, const Frame& frame,
                                 const glm::vec3& wo, float u);

}  // namespace phasetree::tracer
