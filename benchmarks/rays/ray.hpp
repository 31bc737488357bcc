#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "phasetree/model/phase.hpp"

namespace phasetree::bench {

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0};  // of unit length
    Phase carried;           // the phase it is in
    // The crossing it starts from, which a path tracer knows, too: the cell that found it and its gradient.
    std::optional<unsigned> cell{};
    Phase from{};
    glm::vec3 gradient{0};
};

using Rays = std::vector<Ray>;

}  // namespace phasetree::bench
