// Whether a path is reflected or refracted by a smooth interface, chosen by what may come of each.
//
// Glass reflects a twenty-fifth of what falls on it. If that is a lamp, which is a hundred times as bright as what is
// seen through the glass, most of a pixel's light is brought by one sample of twenty-five, and the others are its
// noise. So half of the choice is by Fresnel's odds F, and half by those times the brightness B of the lights in the
// two directions, as if nothing were in the way:
//     q = (F + F B / (F B + (1 − F) B')) / 2.
// A path that is reflected then weighs F/q, one that is refracted (1 − F)/(1 − q), each at most 2.
//
// A direction in glass is not that in which the path will see a lamp. It is taken to leave by a plane parallel to the
// interface, as it does from a pane, and from the wall of a bottle nearly. So what the far side of a pane reflects
// counts as well as what its near side does.
#pragma once

#include <glm/vec3.hpp>

#include "lights/lights.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

struct InterfaceChoice {
    float u_lobe;             ///< makes Bsdf::sample() choose what was chosen
    float odds_over_fresnel;  ///< the probability of that over the one by which Bsdf::sample() alone would choose it
};

/// `bsdf` is that of the surface, which is smooth and clear on both sides, and light leaves it in the direction `wo` of
/// the frame. `u` is in [0, 1). Where all light is reflected, or no light is seen in either direction, it is `u` and 1.
InterfaceChoice chosen_by_lights(const Scene& scene, const Surface& surface, const Bsdf& bsdf, const Frame& frame,
                                 const glm::vec3& wo, float u);

}  // namespace phasetree::tracer
