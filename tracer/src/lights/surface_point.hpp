// A point of a light's surface.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;  ///< unit length, on the emitting side
};

}  // namespace phasetree::tracer
