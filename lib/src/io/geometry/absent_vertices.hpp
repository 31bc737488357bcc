#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::io {

/// The invalid vertices of a file: those with a coordinate that is not a number or too large for a float. Some programs
/// write such vertices without using them in a face. They keep their indices, because faces refer to the other vertices
/// by index.
class AbsentVertices {
  public:
    static constexpr const char* used = "a face has a vertex with a coordinate that is not a number, or too large";

    /// Appends a vertex, which may be invalid.
    void add(TriangleMesh& mesh, const glm::vec3& p) {
        const bool is_there = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        if (!is_there) indices_.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back(is_there ? p : glm::vec3(0));
    }
    bool contain(std::uint32_t vertex) const { return std::ranges::binary_search(indices_, vertex); }
    /// Moves invalid vertices to a corner of a triangle, so that they do not enlarge the bounding box of all vertices.
    void place(TriangleMesh& mesh) const {
        if (mesh.triangles.empty()) return;
        for (const std::uint32_t i : indices_) mesh.vertices[i] = mesh.vertices[mesh.triangles[0].x];
    }

  private:
    std::vector<std::uint32_t> indices_;  // ascending
};

}  // namespace phasetree::io
