// Two colours in alternate cubes: squares on any plane along two axes.
#pragma once

#include <glm/vec3.hpp>

namespace phasetree::tracer {

struct CheckerTexture {
    glm::vec3 even{0.8f};
    glm::vec3 odd{0.2f};
    float size = 1.0f;       // edge of a cube
    glm::vec3 origin{0.0f};  // a corner of an even cube; a plane to be checkered should pass between corners

    glm::vec3 at(const glm::vec3& position) const;
};

}  // namespace phasetree::tracer
