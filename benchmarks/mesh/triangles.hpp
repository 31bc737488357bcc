#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace phasetree::bench {

struct Triangles {
    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> triangles;  // counter-clockwise seen from outside
};

}  // namespace phasetree::bench
