#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "phasetree/model/phase.hpp"

namespace phasetree::bench {

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0};  // of unit length
    Phase carried;           // the phase it is in
};

using Rays = std::vector<Ray>;

}  // namespace phasetree::bench
