// Which of a mesh's two sets of texture coordinates lays an image on it, and how they are transformed. Scene files do
// not name it; images of glTF files have it.
#pragma once

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct ImageCoordinates {
    bool is_second = false;
    std::optional<glm::mat3x2> transform{};  ///< of (u, v, 1)

    /// Where the image is looked up; (0, 0) away from meshes.
    glm::vec2 at(const TexturePoint& p) const {
        if (!p.mesh) return glm::vec2(0.0f);
        const glm::vec2 uv = is_second ? p.mesh->second_uv : p.mesh->uv;
        return transform ? *transform * glm::vec3(uv, 1.0f) : uv;
    }
};

}  // namespace phasetree::tracer
