// Bounding sphere of a light.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct BoundingSphere {
    glm::vec3 centre;
    float radius;
};

}  // namespace phasetree::tracer
