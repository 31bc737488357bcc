#include "shading/normal_map.hpp"

#include <glm/geometric.hpp>

namespace phasetree::tracer {

glm::vec3 NormalMap::normal_at(const TexturePoint& place) const {
    if (!place.mesh || place.mesh->tangent == glm::vec3(0.0f)) return place.normal;
    glm::vec3 n = 2.0f * image->at(place.mesh->uv * repeat) - 1.0f;
    // In a mirrored image, right is the mesh's left.
    n.x *= repeat.x < 0.0f ? -strength : strength;
    n.y *= (repeat.y < 0.0f) != green_down ? -strength : strength;
    const glm::vec3 mapped = n.x * place.mesh->tangent + n.y * place.mesh->bitangent + n.z * place.normal;
    const float length = glm::length(mapped);
    return length > 0.0f ? mapped / length : place.normal;
}

}  // namespace phasetree::tracer
