#include "nodes/mesh_surface.hpp"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "math/disjoint_sets.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/joined_vertices.hpp"

namespace phasetree::mesh {

namespace {

constexpr float farthest_coordinate = 1e9f;

// Throws a description of what is wrong with one mesh.
class Complaint {
  public:
    explicit Complaint(const std::string& name) : name_(name) {}
    [[noreturn]] void operator()(const std::string& what) const { throw UncleanMesh(text(what)); }
    [[noreturn]] void beyond_repair(const std::string& what) const { throw ModelError(text(what)); }

  private:
    std::string text(const std::string& what) const { return fmt::format("mesh: {} {}", name_, what); }

    const std::string& name_;
};

void check_numbers(const TriangleMesh& mesh, const Complaint& complain) {
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(mesh.vertices[i][k]) <= farthest_coordinate))
                complain.beyond_repair(fmt::format(
                    "has a vertex ({}) that is farther than 1e9 m from the origin, or not a number", i + 1));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
            if (mesh.triangles[t][i] >= mesh.vertices.size())
                complain.beyond_repair(fmt::format("has a triangle ({}) with a vertex that does not exist", t + 1));
}

// Adds the triangles of these points in ascending order, each starting with its smallest corner.
void add_triangles(Surface& s, const TriangleMesh& mesh, const JoinedVertices& joined) {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> numbered;
    numbered.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<std::uint32_t, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = joined.of[mesh.triangles[t][static_cast<int>(i)]];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        numbered.emplace_back(corners, static_cast<std::uint32_t>(t + 1));
    }
    tbb::parallel_sort(numbered.begin(), numbered.end());
    s.triangles.reserve(numbered.size());
    s.numbers.reserve(numbered.size());
    for (const auto& [corners, number] : numbered) {
        s.triangles.push_back({corners[0], corners[1], corners[2]});
        s.numbers.push_back(number);
    }
}

// One triangle's use of an edge.
struct EdgeUse {
    std::uint32_t low, high, triangle;
    bool is_rising;  // whether the triangle traverses it from the low to the high vertex
};

std::vector<EdgeUse> uses_of_edges(const Surface& s) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * s.triangles.size());
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = s.triangles[t][i], b = s.triangles[t][(i + 1) % 3];
            uses.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    tbb::parallel_sort(uses.begin(), uses.end(), [](const EdgeUse& u, const EdgeUse& v) {
        return std::tuple(u.low, u.high, !u.is_rising, u.triangle) <
               std::tuple(v.low, v.high, !v.is_rising, v.triangle);
    });
    return uses;
}

// Calls f(span) with all uses of each edge.
template <class F>
void for_each_edge(const Surface& s, F&& f) {
    const std::vector<EdgeUse> uses = uses_of_edges(s);
    for (std::size_t i = 0, next = 0; i < uses.size(); i = next) {
        while (next < uses.size() && uses[next].low == uses[i].low && uses[next].high == uses[i].high) ++next;
        f(std::span(uses).subspan(i, next - i));
    }
}

// Pairs the triangles at each edge.
void join(Surface& s, const Complaint& complain) {
    std::optional<EdgeUse> open;
    std::size_t open_edges = 0;
    s.edges.reserve(3 * s.triangles.size() / 2);
    for_each_edge(s, [&](std::span<const EdgeUse> uses) {
        const EdgeUse& u = uses[0];
        const auto edge_text = [&] {
            return fmt::format("the edge from {} to {}", written(s.at(u.low)), written(s.at(u.high)));
        };
        if (uses.size() == 1) {
            if (!open) open = u;
            ++open_edges;
        } else if (uses.size() > 2) {
            complain(fmt::format("touches itself: {} has {} triangles, among them {} and {}", edge_text(), uses.size(),
                                 s.numbers[u.triangle], s.numbers[uses[2].triangle]));
        } else if (u.is_rising == uses[1].is_rising) {
            complain(fmt::format("has triangles of opposite orientation: {} and {} at {}", s.numbers[u.triangle],
                                 s.numbers[uses[1].triangle], edge_text()));
        } else {
            s.edges.push_back({{u.low, u.high}, {u.triangle, uses[1].triangle}});
        }
    });
    if (open)
        complain(fmt::format("is not closed: the edge from {} to {} has a triangle ({}) on one side only{}",
                             written(s.at(open->low)), written(s.at(open->high)), s.numbers[open->triangle],
                             open_edges > 1 ? fmt::format(", and so do {} more edges", open_edges - 1) : ""));
}

// The index of the corner of a triangle at a vertex.
std::size_t corner_at(const Surface& s, std::uint32_t triangle, std::uint32_t vertex) {
    const glm::uvec3& t = s.triangles[triangle];
    return 3 * std::size_t{triangle} + (t.x == vertex ? 0u : t.y == vertex ? 1u : 2u);
}

// Requires that the triangles around each vertex form a single ring.
void require_single_rings(const Surface& s, const Complaint& complain) {
    DisjointSets corners(3 * s.triangles.size());
    for (const SharedEdge& e : s.edges)
        for (const std::uint32_t v : e.ends)
            corners.join(corner_at(s, e.triangles[0], v), corner_at(s, e.triangles[1], v));
    constexpr auto none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> ring(s.vertices.size(), none);
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t vertex = s.triangles[t][i];
            const std::size_t root = corners.root(3 * std::size_t{t} + static_cast<std::size_t>(i));
            if (ring[vertex] == none) ring[vertex] = root;
            if (ring[vertex] != root)
                complain(
                    fmt::format("touches itself at {}, a corner of its triangles {} and {}, which are not joined "
                                "around it",
                                written(s.at(vertex)), s.numbers[ring[vertex] / 3], s.numbers[t]));
        }
}

// 0 if the triangle has no area.
glm::dvec3 normal_of(const Surface& s, std::uint32_t t) {
    const glm::dvec3 a = s.corner(t, 0), u = s.corner(t, 1) - a, v = s.corner(t, 2) - a;
    const glm::dvec3 n = glm::cross(u, v);
    const double length = glm::length(n), longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(u - v, u - v)});
    return length > 1e-12 * longest ? n / length : glm::dvec3(0);
}

void add_normals(Surface& s) {
    s.normals.reserve(s.triangles.size());
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) s.normals.push_back(normal_of(s, t));
}
void require_areas(const Surface& s, const Complaint& complain) {
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        if (s.normals[t] == glm::dvec3(0))
            complain(fmt::format("has a triangle without area: {}, with corners at {}, {} and {}", s.numbers[t],
                                 written(s.corner(t, 0)), written(s.corner(t, 1)), written(s.corner(t, 2))));
}

// Removes all but the first of equal triangles.
void remove_equal(Surface& s) {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> sorted(s.triangles.size());
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        std::array<std::uint32_t, 3> corners{s.triangles[t].x, s.triangles[t].y, s.triangles[t].z};
        std::ranges::sort(corners);
        sorted[t] = {corners, t};
    }
    tbb::parallel_sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (i == 0 || sorted[i].first != sorted[i - 1].first) kept.push_back(sorted[i].second);
    std::ranges::sort(kept);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        s.triangles[i] = s.triangles[kept[i]];
        s.numbers[i] = s.numbers[kept[i]];
    }
    s.triangles.resize(kept.size());
    s.numbers.resize(kept.size());
}

// The triangles of a mesh, which may have any edges.
Surface triangles_of(const TriangleMesh& mesh, const Complaint& complain) {
    check_numbers(mesh, complain);
    JoinedVertices joined = join_vertices(mesh.vertices, mesh.triangles);
    Surface s;
    add_triangles(s, mesh, joined);
    s.vertices = std::move(joined.points);
    if (s.triangles.empty()) complain.beyond_repair("has no triangles");
    return s;
}

}  // namespace

std::vector<Bounds> boxes_of(const Surface& s) {
    std::vector<Bounds> boxes;
    boxes.reserve(s.triangles.size());
    for (const glm::uvec3& t : s.triangles) {
        Bounds b;
        for (int i = 0; i < 3; ++i) b = unite(b, {s.vertices[t[i]], s.vertices[t[i]]});
        boxes.push_back(b);
    }
    return boxes;
}

std::string written(const glm::dvec3& p) {
    return fmt::format("[{:.7g}, {:.7g}, {:.7g}]", p.x, p.y, p.z);
}

Surface surface_of(const TriangleMesh& mesh, const std::string& name) {
    const Complaint complain(name);
    Surface s = triangles_of(mesh, complain);
    join(s, complain);
    require_single_rings(s, complain);
    add_normals(s);
    require_areas(s, complain);
    for (const SharedEdge& e : s.edges)
        if (glm::length(s.normals[e.triangles[0]] + s.normals[e.triangles[1]]) < 1e-4)
            complain(fmt::format("is folded onto itself: triangles {} and {} coincide at the edge from {} to {}",
                                 s.numbers[e.triangles[0]], s.numbers[e.triangles[1]], written(s.at(e.ends[0])),
                                 written(s.at(e.ends[1]))));
    return s;
}

Surface sheet_of(const TriangleMesh& mesh, const std::string& name) {
    Surface s = triangles_of(mesh, Complaint(name));
    remove_equal(s);
    add_normals(s);
    for_each_edge(s, [&](std::span<const EdgeUse> uses) {
        const std::uint32_t one = uses[0].triangle, other = uses.size() == 2 ? uses[1].triangle : one;
        const bool faces_one_way = one != other && uses[0].is_rising != uses[1].is_rising &&
                                   glm::length(s.normals[one]) * glm::length(s.normals[other]) > 0 &&
                                   glm::length(s.normals[one] + s.normals[other]) > 1e-4;
        s.edges.push_back({{uses[0].low, uses[0].high}, {one, faces_one_way ? other : one}});
    });
    return s;
}

}  // namespace phasetree::mesh
