// A sampled direction towards a light, and its pdf.
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

struct DirectionSample {
    glm::vec3 direction;  ///< unit length, towards the light
    float pdf;            ///< per steradian
};

}  // namespace phasetree::tracer
