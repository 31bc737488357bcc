#pragma once

/// Closed surfaces of triangles.

#include <map>
#include <memory>
#include <utility>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/triangle_mesh.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

inline TriangleMesh octahedron_mesh() {
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// Each triangle becomes four, with the middles of its edges.
inline TriangleMesh subdivided(const TriangleMesh& mesh) {
    TriangleMesh result{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, result.vertices.size());
        if (is_new) result.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
        return at->second;
    };
    for (const glm::uvec3& t : mesh.triangles) {
        const std::uint32_t a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
        for (const glm::uvec3& part : {glm::uvec3(t.x, a, c), {a, t.y, b}, {c, b, t.z}, {a, b, c}})
            result.triangles.push_back(part);
    }
    return result;
}

/// A surface around the origin with vertices between `low` and 1 away from it, which each ray from there meets once.
/// Half of its distances are multiples of a quarter.
inline TriangleMesh random_mesh(Random& rng, int subdivisions, float low) {
    TriangleMesh mesh = octahedron_mesh();
    for (; subdivisions > 0; --subdivisions) mesh = subdivided(mesh);
    for (glm::vec3& v : mesh.vertices) {
        const float far = rng.uniform(low, 1);
        v = (rng.chance(0.5) ? std::max(std::round(4 * far) / 4, low) : far) * glm::normalize(v);
    }
    return mesh;
}

inline FromFile<TriangleMesh> held(TriangleMesh mesh) {
    FromFile<TriangleMesh> file;
    file.content = std::make_shared<const TriangleMesh>(std::move(mesh));
    return file;
}

}  // namespace phasetree::tests
