// A photon: light that came from a lamp through at least one smooth interface of clear phases and fell on something
// that is not clear. It stands for the whole chain of interfaces behind it.
#pragma once

#include <glm/vec3.hpp>

#include "lights/lights.hpp"
#include "phasetree/model/phase.hpp"

namespace phasetree::tracer {

struct Photon {
    glm::vec3 position;   ///< where it fell
    glm::vec3 direction;  ///< of unit length, from there to where it came from
    glm::vec3 power;      ///< radiance of the light over p(line), less what was absorbed on the way
    /// p(line)/m²: how densely the photon's line was sampled at the light, p(line), per area perpendicular to it and
    /// steradian, over the square of the refractive index m around the light. Of a point light, per steradian alone.
    float line_density;
    Phase phase;                  ///< in which it travelled when it fell
    Lights::Emission emission;    ///< of the light, and
    glm::vec3 towards_light;      ///< the direction in which it is seen from where the photon met the first interface
    bool of_point_light = false;  ///< no other technique finds such light
    bool of_one_wavelength = false;  ///< that of its map, and then `power` is what it is at this wavelength
};

}  // namespace phasetree::tracer
