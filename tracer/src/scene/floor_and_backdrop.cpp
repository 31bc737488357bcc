#include <cmath>
#include <utility>

#include "scene/mesh_kinds.hpp"

namespace phasetree::tracer {

Mesh FloorParameters::made() const {
    const float z = height;
    const float half = 0.5f * size;
    Mesh mesh{.opacity = opacity(), .material = material};
    mesh.vertices = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh BackdropParameters::made() const {
    const float z = height;
    const float half = 0.5f * width;
    constexpr int steps = 64;
    std::vector<std::pair<glm::vec2, glm::vec2>> profile;  // (y, z), and the normal in that plane
    profile.push_back({{-front, z}, {0, 1}});
    for (int i = 0; i <= steps; ++i) {
        const float a = 0.5f * 3.14159265f * static_cast<float>(i) / steps;
        const glm::vec2 n{-std::sin(a), std::cos(a)};
        profile.push_back({glm::vec2(distance - radius, z + radius) - radius * n, n});
    }
    profile.push_back({{distance, z + radius + wall}, {-1, 0}});
    Mesh mesh{.opacity = opacity(), .material = material};
    for (const auto& [p, n] : profile) {
        for (const float x : {-half, half}) {
            mesh.vertices.emplace_back(x, p.x, p.y);
            mesh.normals.values.emplace_back(0.0f, n.x, n.y);
        }
    }
    for (unsigned i = 0; i + 1 < profile.size(); ++i) {
        mesh.triangles.emplace_back(2 * i, 2 * i + 1, 2 * i + 3);
        mesh.triangles.emplace_back(2 * i, 2 * i + 3, 2 * i + 2);
    }
    return mesh;
}

}  // namespace phasetree::tracer
