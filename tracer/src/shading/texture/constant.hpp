// The same colour everywhere.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct ConstantTexture {
    glm::vec3 color{0.8f};

    glm::vec3 at(const glm::vec3& /*position*/) const { return color; }
};

}  // namespace phasetree::tracer
