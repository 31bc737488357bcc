// A point of a light's surface.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;  ///< of unit length, on the side that emits
};

}  // namespace phasetree::tracer
