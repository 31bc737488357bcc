// Tests whether a surface crosses itself, and which side of it is outside.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "math/disjoint_sets.hpp"
#include "model/preparation.hpp"
#include "nodes/box_tree.hpp"
#include "nodes/mesh_surface.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::mesh {

namespace {

bool overlap(const Bounds& a, const Bounds& b) {
    return !intersect(a, b).empty();
}

// The side of the plane through a, b and c on which the point d lies: 1, −1, or 0 if rounding errors could change it.
// The error bound is that of Shewchuk, "Adaptive Precision Floating-Point Arithmetic" (1997), rounded up.
int side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 u = a - d, v = b - d, w = c - d;
    const double vw = v.x * w.y, wv = w.x * v.y, wu = w.x * u.y, uw = u.x * w.y, uv = u.x * v.y, vu = v.x * u.y;
    const double determinant = u.z * (vw - wv) + v.z * (wu - uw) + w.z * (uv - vu);
    const double size = std::abs(u.z) * (std::abs(vw) + std::abs(wv)) + std::abs(v.z) * (std::abs(wu) + std::abs(uw)) +
                        std::abs(w.z) * (std::abs(uv) + std::abs(vu));
    const double error = 1e-15 * size;
    return determinant > error ? 1 : determinant < -error ? -1 : 0;
}

// Whether the segment from p to q passes through the triangle, or across one of its edges from one side to the other.
bool goes_through(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
    if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) >= 0) return false;
    int seen = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const int s = side(p, q, t[i], t[(i + 1) % 3]);
        if (s * seen < 0) return false;
        if (s != 0) seen = s;
    }
    return true;
}

// Whether two triangles cross. If they share a vertex, testing the edges opposite to it is enough.
bool cross(const Surface& s, std::uint32_t one, std::uint32_t other) {
    const auto goes = [&](std::uint32_t edges_of, std::uint32_t through) {
        const glm::uvec3 &a = s.triangles[edges_of], &b = s.triangles[through];
        const auto is_shared = [&](std::uint32_t v) { return v == b.x || v == b.y || v == b.z; };
        const std::array<glm::dvec3, 3> corners{s.corner(through, 0), s.corner(through, 1), s.corner(through, 2)};
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t p = a[i], q = a[(i + 1) % 3];
            if (!is_shared(p) && !is_shared(q) && goes_through(s.at(p), s.at(q), corners)) return true;
        }
        return false;
    };
    return goes(one, other) || goes(other, one);
}

// Whether two triangles in the same plane with opposite outsides overlap in an area. All points above it would be
// equally near to both.
bool lie_on_each_other(const Surface& s, std::uint32_t one, std::uint32_t other) {
    if (!(glm::dot(s.normals[one], s.normals[other]) < -0.999999)) return false;
    for (int i = 0; i < 3; ++i)
        if (side(s.corner(one, 0), s.corner(one, 1), s.corner(one, 2), s.corner(other, i)) != 0) return false;
    const auto has_side_between = [&](std::uint32_t t, std::uint32_t u) {
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 a = s.corner(t, i), outward = glm::cross(s.corner(t, (i + 1) % 3) - a, s.normals[t]);
            bool are_beyond = true;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 away = s.corner(u, k) - a;
                if (glm::dot(outward, away) < -1e-9 * glm::length(outward) * glm::length(away)) are_beyond = false;
            }
            if (are_beyond) return true;
        }
        return false;
    };
    return !has_side_between(one, other) && !has_side_between(other, one);
}

// The winding number of a surface around a point, from the crossings of a ray with the triangles that are not left out.
// Returns nullopt if the ray comes too close to an edge for a reliable result.
template <class IsLeftOut>
std::optional<int> winding_number(const Surface& s, const BoxTree& tree, const glm::dvec3& p, const glm::dvec3& d,
                                  const IsLeftOut& is_left_out) {
    int winding = 0;
    bool is_in_doubt = false;
    const auto is_met = [&](const Bounds& box) {
        double enter = 0, leave = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 3; ++i) {
            const double low = (static_cast<double>(box.low[i]) - p[i]) / d[i];
            const double high = (static_cast<double>(box.high[i]) - p[i]) / d[i];
            enter = std::max(enter, std::min(low, high));
            leave = std::min(leave, std::max(low, high));
        }
        return enter <= leave * (1 + 1e-12);
    };
    tree.for_each_leaf(is_met, [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; ++i) {
            const std::uint32_t t = tree.order[i];
            if (is_left_out(t)) continue;
            std::array<glm::dvec3, 3> q;
            for (int k = 0; k < 3; ++k) q[static_cast<std::size_t>(k)] = s.corner(t, k) - p;
            std::array<double, 3> turn;
            double size = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 &a = q[k], &b = q[(k + 1) % 3];
                turn[k] = glm::dot(d, glm::cross(a, b));
                size = std::max(size, glm::length(a) * glm::length(b));
            }
            const auto [least, most] = std::minmax({turn[0], turn[1], turn[2]});
            const double rounding_error = 1e-12 * size;
            if (least < -rounding_error && most > rounding_error) continue;
            const double height = glm::dot(s.normals[t], q[0]) / glm::dot(s.normals[t], d);
            if (height < 0) continue;
            if (least < rounding_error && most > -rounding_error) {
                is_in_doubt = true;
                continue;
            }
            winding += most > 0 ? 1 : -1;
        }
    });
    if (is_in_doubt) return std::nullopt;
    return winding;
}

}  // namespace

void require_no_crossing(const Surface& s, const BoxTree& tree, const std::string& name, model::Preparation& work) {
    const std::vector<Bounds> boxes = boxes_of(s);
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
        if (tree.nodes[i].second_child == 0) leaves.push_back(i);
    // Each pair of leaves is visited once, from the first one.
    constexpr std::size_t in_chunk = 256;
    constexpr std::uint64_t steps_of_pair = 40, steps_of_box = 1;
    const std::size_t chunks = (leaves.size() + in_chunk - 1) / in_chunk;
    const std::uint64_t most_steps = work.left();
    std::atomic<std::uint64_t> steps = 0;
    std::atomic<bool> is_crossed = false;
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        if (is_crossed || steps > most_steps) return;
        work.poll();
        std::uint64_t own_steps = 0;
        const std::size_t end = std::min((chunk + 1) * in_chunk, leaves.size());
        for (std::size_t l = chunk * in_chunk; l < end && !is_crossed; ++l) {
            const BoxTree::Node& leaf = tree.nodes[leaves[l]];
            const auto is_near = [&](const Bounds& box) {
                own_steps += steps_of_box;
                return overlap(box, leaf.box);
            };
            tree.for_each_leaf_from(leaves[l], is_near, [&](std::uint32_t first, std::uint32_t count) {
                for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
                    for (std::uint32_t k = std::max(first, i + 1); k < first + count; ++k) {
                        const std::uint32_t t = tree.order[i], u = tree.order[k];
                        if (!overlap(boxes[t], boxes[u])) continue;
                        own_steps += steps_of_pair;
                        if (cross(s, t, u) || lie_on_each_other(s, t, u)) is_crossed = true;
                    }
            });
        }
        steps += own_steps;
    });
    work.pay(steps);
    if (is_crossed) throw UncleanMesh(fmt::format("mesh: {} crosses or touches itself", name));
}

void require_outward(const Surface& s, const BoxTree& tree, const std::string& name, model::Preparation& work) {
    DisjointSets shells(s.triangles.size());
    for (const SharedEdge& e : s.edges) shells.join(e.triangles[0], e.triangles[1]);
    std::vector<double> volume(s.triangles.size(), 0);
    std::vector<std::uint32_t> roots;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        const auto root = static_cast<std::uint32_t>(shells.root(t));
        if (root == t) roots.push_back(t);
        const glm::dvec3 origin = s.corner(root, 0);
        volume[root] += glm::dot(s.corner(t, 0) - origin, glm::cross(s.corner(t, 1) - origin, s.corner(t, 2) - origin));
    }
    if (roots.size() == 1) {
        if (volume[0] > 0) return;
        throw UncleanMesh(fmt::format("mesh: {} is inside out: its triangles are clockwise seen from outside", name));
    }
    for (const std::uint32_t root : roots) {
        const int expected = volume[root] > 0 ? 0 : 1;
        std::optional<int> winding;
        // Any directions will do, as long as no mesh is likely to be aligned with them.
        for (int attempt = 0; attempt < 16 && !winding; ++attempt) {
            work.pay(200 + s.triangles.size() / 50);
            const double turn = 2.39996 * attempt + 0.3, z = 0.137 + 0.051 * attempt;
            const glm::dvec3 d(std::cos(turn), std::sin(turn), z);
            winding =
                winding_number(s, tree, s.corner(root, 0), d, [&](std::uint32_t t) { return shells.root(t) == root; });
        }
        if (winding == expected) continue;
        throw UncleanMesh(fmt::format("mesh: {} has a part that is {}: that of its triangle {} at {}", name,
                                      volume[root] > 0 ? "within its solid" : "inside out", s.numbers[root],
                                      written(s.corner(root, 0))));
    }
}

}  // namespace phasetree::mesh
