#pragma once

#include <functional>

#include "phasetree/trace/crossing.hpp"

namespace phasetree {

/// The normal of a crossing, from the components' gradients.
CrossingNormal normal_of(const Crossing&, const glm::vec3& direction,
                         const std::function<glm::vec3(const glm::vec3&, Phase)>& gradient);

}  // namespace phasetree
