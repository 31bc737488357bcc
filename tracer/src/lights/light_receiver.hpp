// A point that receives light.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace phasetree::tracer {

/// A point and, on an opaque surface, the unit normal there. Light from below that surface does not count.
struct LightReceiver {
    glm::vec3 p{0};
    std::optional<glm::vec3> normal{};

    LightReceiver(const glm::vec3& point = glm::vec3(0)) : p(point) {}
    LightReceiver(const glm::vec3& point, const glm::vec3& up) : p(point), normal(up) {}
};

}  // namespace phasetree::tracer
