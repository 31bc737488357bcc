// A place on a surface, as textures see it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace phasetree::tracer {

struct TexturePoint {
    glm::vec3 position;                  ///< in the object's own space, in the scene's unit of length
    glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< of unit length, to either side
    std::optional<glm::vec2> uv{};       ///< a mesh's texture coordinates, if it has any

    TexturePoint(const glm::vec3& p) : position(p) {}
    TexturePoint(const glm::vec3& p, const glm::vec3& n, const std::optional<glm::vec2>& coordinates)
        : position(p), normal(n), uv(coordinates) {}
};

}  // namespace phasetree::tracer
