#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace phasetree {

/// Triangles in space, as read from a file. Corners are indices of vertices, counterclockwise as seen from outside.
struct TriangleMesh {
    /// The maximum that file readers and nodes accept.
    static constexpr std::size_t max_triangles = 2'000'000;

    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> triangles;

    std::size_t bytes() const {
        return vertices.size() * sizeof(vertices[0]) + triangles.size() * sizeof(triangles[0]);
    }
};

}  // namespace phasetree
