#pragma once

#include <functional>

#include "phasetree/trace/crossing.hpp"

namespace phasetree {

/// Unit normal of a crossing, from `from` into `to`, so that it points along the ray; from the components' gradients.
glm::vec3 normal_of(const Crossing&, const glm::vec3& direction,
                    const std::function<glm::vec3(const glm::vec3&, Phase)>& gradient);

}  // namespace phasetree
