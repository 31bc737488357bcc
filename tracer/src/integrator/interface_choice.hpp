// Whether a path is reflected or refracted by a smooth interface, chosen by what may come of each.
//
// Glass reflects a twenty-fifth of what falls on it. If that is a lamp, which is a hundred times as bright as what is
// seen through the glass, most of a pixel's light is brought by one sample of twenty-five, and the others are its
// noise. So a path is reflected with the probability
//     q = (F + F B / (F B + (1 − F) B')) / 2,
// where F is Fresnel's reflectance, and B and B' are how bright the lights are in the directions in which the path
// would be reflected and refracted, as if nothing were in the way; of what glows or shines, B is the luminance of
// the brightest ball (lights/glowing_part.hpp) in that direction. A path that is reflected then weighs F/q, and one
// that is refracted (1 − F)/(1 − q), each at most 2.
//
// A direction in glass is not that in which the path will see a lamp. The path is taken to leave the glass by a plane
// parallel to the interface, as it does from a pane, and from the wall of a bottle nearly. So lamps that the far side
// of a pane reflects count, too.
#pragma once

#include <glm/vec3.hpp>

#include "lights/lights.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// As a lobe's number it makes a smooth interface refract, if it refracts at all; 0 makes it reflect.
inline constexpr float greatest_below_one = 0x1.fffffep-1f;

struct InterfaceChoice {
    float u_lobe;             ///< for Bsdf::sample(), which then goes the way that was chosen
    float odds_over_fresnel;  ///< q/F or (1 − q)/(1 − F), by which the weight of that sample is to be divided
};

/// `bsdf` is the surface's, which is smooth and clear on both sides, and `wo`, in the frame, is where the light goes
/// that leaves it. `u` is in [0, 1). Where all light is reflected, or no light is seen in either direction, the choice
/// is `u` and 1, which leaves it to Fresnel's odds.
InterfaceChoice chosen_by_lights(const Scene& scene, const Surface& surface, const Bsdf& bsdf, const Frame& frame,
                                 const glm::vec3& wo, float u);

}  // namespace phasetree::tracer
