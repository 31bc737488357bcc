// A point on a surface, as seen by textures.
#pragma once

#include <cstdint>
#include <glm/mat2x3.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace phasetree::tracer {

/// Attributes interpolated from a mesh's vertices. The gradients are along the surface, per unit length.
struct MeshCoordinates {
    glm::vec2 uv{0.0f};                 ///< texture coordinates
    glm::mat2x3 gradients{0.0f};        ///< ∇u and ∇v
    glm::vec3 color{1.0f};              ///< linear Rec.709
    glm::mat3x3 color_gradients{0.0f};  ///< ∇ of red, of green and of blue
    float alpha = 1.0f;                 ///< of the vertices' colours
    /// A second set of texture coordinates, with its gradients; 0 if the mesh has none.
    glm::vec2 second_uv{0.0f};
    glm::mat2x3 second_gradients{0.0f};
    /// The direction in which u grows and that in which v does, of unit length and perpendicular to the normal and to
    /// each other; 0 if the mesh has no tangents. On a mesh that is seen from behind, both are turned round.
    glm::vec3 tangent{0.0f}, bitangent{0.0f};
};

struct TexturePoint {
    glm::vec3 position;                  ///< in object space, in the scene's unit of length
    glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit length, on either side
    std::optional<MeshCoordinates> mesh{};
    bool is_back = false;    ///< of a mesh: whether it is seen from behind
    std::uint32_t copy = 0;  ///< number of the copy of the object (scene/placed.hpp); 0 for an object that exists once

    TexturePoint(const glm::vec3& p) : position(p) {}
    TexturePoint(const glm::vec3& p, const glm::vec3& n, const std::optional<MeshCoordinates>& coordinates)
        : position(p), normal(n), mesh(coordinates) {}

    /// A nearby point on the surface, which is assumed to be flat.
    TexturePoint moved(const glm::vec3& by) const {
        TexturePoint there = *this;
        there.position += by;
        if (mesh) {
            there.mesh->uv += by * mesh->gradients;
            there.mesh->color += by * mesh->color_gradients;
            there.mesh->second_uv += by * mesh->second_gradients;
        }
        return there;
    }
};

}  // namespace phasetree::tracer
