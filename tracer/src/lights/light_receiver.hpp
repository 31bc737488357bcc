// Where light is looked for.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace phasetree::tracer {

/// A point, and, if it is on a surface that light does not pass, the unit normal there. No light from below that
/// counts.
struct LightReceiver {
    glm::vec3 p{0};
    std::optional<glm::vec3> normal{};

    LightReceiver(const glm::vec3& point = glm::vec3(0)) : p(point) {}
    LightReceiver(const glm::vec3& point, const glm::vec3& up) : p(point), normal(up) {}
};

}  // namespace phasetree::tracer
