#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "phasetree/nodes/fields/triangle_mesh.hpp"

namespace phasetree::io {

/// The vertices of a file that are no points, because a coordinate is no number or beyond floats. Programs write some
/// that no face has. They keep their places in the list of vertices, by which faces name the others.
class AbsentVertices {
  public:
    static constexpr const char* used = "a face has a vertex of which a coordinate is no number, or is too large";

    /// Appends a vertex, which may be absent.
    void add(TriangleMesh& mesh, const glm::vec3& p) {
        const bool is_there = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        if (!is_there) indices_.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back(is_there ? p : glm::vec3(0));
    }
    bool contain(std::uint32_t vertex) const { return std::ranges::binary_search(indices_, vertex); }
    /// Puts them where a triangle has a corner, so that a box around all vertices is not larger for them.
    void place(TriangleMesh& mesh) const {
        if (mesh.triangles.empty()) return;
        for (const std::uint32_t i : indices_) mesh.vertices[i] = mesh.vertices[mesh.triangles[0].x];
    }

  private:
    std::vector<std::uint32_t> indices_;  // rising
};

}  // namespace phasetree::io
