#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "phasetree/model/phase.hpp"

namespace phasetree::bench {

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0};          // of unit length
    Phase carried;                   // the phase it is in
    std::optional<unsigned> cell{};  // that found the crossing it starts from; a path tracer knows it, too
};

using Rays = std::vector<Ray>;

}  // namespace phasetree::bench
