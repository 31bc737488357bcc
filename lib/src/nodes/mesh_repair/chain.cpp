#include "nodes/mesh_repair/chain.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "nodes/mesh_repair/vertex_at.hpp"
#include "phasetree/nodes/fields/joined_vertices.hpp"

namespace phasetree::mesh {

namespace {

constexpr int lattice_bits = 23;

// The same triangle with its corners in ascending order.
ChainTriangle sorted_corners(ChainTriangle t) {
    auto& c = t.corners;
    for (const auto& [i, j] : {std::pair(0u, 1u), std::pair(1u, 2u), std::pair(0u, 1u)})
        if (c[i] > c[j]) {
            std::swap(c[i], c[j]);
            t.times = -t.times;
        }
    return t;
}

bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The lattice points of these vertices, in ascending order, and for each vertex the index of its point.
std::vector<std::uint32_t> snap(const std::vector<glm::vec3>& vertices, Chain& chain) {
    float largest = 1e-30f;
    for (const glm::vec3& v : vertices)
        for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(v[i]));
    chain.step = std::ldexp(1.0, std::ilogb(largest) + 1 - lattice_bits);
    std::vector<std::pair<glm::dvec3, std::uint32_t>> snapped(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        snapped[v] = {glm::round(glm::dvec3(vertices[v]) / chain.step) + 0.0, v};
    tbb::parallel_sort(snapped.begin(), snapped.end(), [](const auto& a, const auto& b) {
        return is_before(a.first, b.first) || (a.first == b.first && a.second < b.second);
    });
    std::vector<std::uint32_t> index(vertices.size());
    for (const auto& [point, v] : snapped) {
        if (chain.points.empty() || chain.points.back() != point) chain.points.push_back(point);
        index[v] = static_cast<std::uint32_t>(chain.points.size() - 1);
    }
    return index;
}

}  // namespace

std::vector<EdgeOfChain> edges_of(const Chain& chain) {
    std::vector<EdgeOfChain> edges(3 * chain.triangles.size());
    for (std::uint32_t t = 0; t < chain.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = chain.triangles[t].corners[i], b = chain.triangles[t].corners[(i + 1) % 3];
            edges[3 * t + i] = {std::min(a, b), std::max(a, b), t, a < b};
        }
    tbb::parallel_sort(edges.begin(), edges.end(), [](const EdgeOfChain& a, const EdgeOfChain& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return edges;
}

void merge_equal(std::vector<ChainTriangle>& triangles) {
    for (ChainTriangle& t : triangles) t = sorted_corners(t);
    tbb::parallel_sort(triangles.begin(), triangles.end(), [](const ChainTriangle& a, const ChainTriangle& b) {
        return std::tie(a.corners, a.times) < std::tie(b.corners, b.times);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (kept > 0 && triangles[kept - 1].corners == triangles[i].corners)
            triangles[kept - 1].times += triangles[i].times;
        else
            triangles[kept++] = triangles[i];
    triangles.resize(kept);
    std::erase_if(triangles, [](const ChainTriangle& t) { return t.times == 0; });
}

Chain welded(const TriangleMesh& mesh) {
    const JoinedVertices joined = join_vertices(mesh.vertices, mesh.triangles);
    Chain chain;
    const std::vector<std::uint32_t> index = snap(joined.points, chain);
    chain.triangles.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<std::uint32_t, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = index[joined.of[t[static_cast<int>(i)]]];
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            chain.triangles.push_back({corners});
    }
    VertexAt(chain).join_touching();
    merge_equal(chain.triangles);
    for (ChainTriangle& t : chain.triangles) {
        if (t.times < 0) std::swap(t.corners[1], t.corners[2]);
        t.times = 1;
    }
    return chain;
}

}  // namespace phasetree::mesh
