// Vertex colours of a mesh, such as those of scans, interpolated linearly.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "phasetree/io/kind.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct VertexColorTexture {
    static constexpr KindInfo info{"vertex_color", "The vertex colours in the mesh file, as scans have them."};

    template <class V>
    static void parameters(V&&) {}

    // The reader of scenes rejects meshes without colours. Bumps evaluate points slightly outside of triangles.
    glm::vec3 at(const TexturePoint& p) const {
        return p.mesh ? glm::clamp(p.mesh->color, glm::vec3(0.0f), glm::vec3(1.0f)) : glm::vec3(1.0f);
    }
};

}  // namespace phasetree::tracer
