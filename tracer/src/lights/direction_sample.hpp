// What sampling a light yields: a direction towards it and how densely it was sampled.
#pragma once

#include <glm/glm.hpp>

namespace phasetree::tracer {

struct DirectionSample {
    glm::vec3 direction;  ///< unit length, towards the light
    float pdf;            ///< per steradian
};

}  // namespace phasetree::tracer
