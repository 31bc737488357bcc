#include "nodes/mesh_repair/cells.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "nodes/mesh_repair/chain_winding.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::mesh {

namespace {

// A triangle at an edge, and the angle around the edge, seen against its direction from the low to the high vertex.
struct AtAngle {
    double angle;
    EdgeOfChain use;
};

std::vector<AtAngle> by_angle(const Chain& chain, std::span<const EdgeOfChain> uses) {
    const glm::dvec3 a = chain.points[uses[0].low], axis = glm::normalize(chain.points[uses[0].high] - a);
    const glm::dvec3 other = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, axis)), y = glm::cross(axis, x);
    std::vector<AtAngle> result;
    for (const EdgeOfChain& e : uses) {
        const auto& c = chain.triangles[e.triangle].corners;
        const std::uint32_t apex = c[0] != e.low && c[0] != e.high   ? c[0]
                                   : c[1] != e.low && c[1] != e.high ? c[1]
                                                                     : c[2];
        const glm::dvec3 p = chain.points[apex] - a;
        result.push_back({portable::atan2(glm::dot(p, y), glm::dot(p, x)), e});
    }
    std::ranges::stable_sort(result, {}, &AtAngle::angle);
    return result;
}

// Calls f(use, next) for each sector around an edge, with the triangles that bound it.
template <class F>
void for_each_sector(const Chain& chain, std::span<const EdgeOfChain> uses, F&& f) {
    if (uses.size() == 1) return f(uses[0], uses[0], 2 * std::numbers::pi);
    if (uses.size() == 2) {
        f(uses[0], uses[1], std::numbers::pi);
        f(uses[1], uses[0], std::numbers::pi);
        return;
    }
    const std::vector<AtAngle> sorted = by_angle(chain, uses);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const bool is_last = i + 1 == sorted.size();
        const AtAngle& next = sorted[is_last ? 0 : i + 1];
        f(sorted[i].use, next.use, next.angle - sorted[i].angle + (is_last ? 2 * std::numbers::pi : 0));
    }
}

// Disjoint sets of connected sides of triangles: side 2 t is in front of triangle t, side 2 t + 1 behind it. The
// winding number on each side is known relative to that of its set's root.
class ConnectedSides {
  public:
    explicit ConnectedSides(std::size_t n) : parent_(n), more_(n, 0) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    struct Known {
        std::uint32_t root;
        std::int64_t more;  // than at the root
    };
    Known root(std::uint32_t i) {
        std::uint32_t top = i;
        std::int64_t more = 0;
        while (parent_[top] != top) {
            more += more_[top];
            top = parent_[top];
        }
        std::int64_t left = more;
        while (i != top) {
            const std::uint32_t next = parent_[i];
            const std::int64_t own = more_[i];
            parent_[i] = top;
            more_[i] = left;
            left -= own;
            i = next;
        }
        return {top, more};
    }
    // The winding number on side b is larger by `more` than that on side a.
    void join(std::uint32_t a, std::uint32_t b, std::int64_t more) {
        const Known p = root(a), q = root(b);
        if (p.root == q.root) return;
        const std::int64_t between = p.more + more - q.more;  // from the root of a to that of b
        if (p.root < q.root) {
            parent_[q.root] = p.root;
            more_[q.root] = between;
        } else {
            parent_[p.root] = q.root;
            more_[p.root] = -between;
        }
    }

  private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::int64_t> more_;
};

bool is_inside(std::int64_t winding, WindingRule rule) {
    if (rule == WindingRule::winding_number) return winding >= 1;
    return rule == WindingRule::even_odd ? winding % 2 != 0 : winding != 0;
}

}  // namespace

std::vector<SideWinding> windings_of(const Chain& chain) {
    const auto n = static_cast<std::uint32_t>(chain.triangles.size());
    // First join the sides that face the same sector, so that no later contradiction can separate them.
    ConnectedSides sides(2 * std::size_t{n});
    for_each_edge(edges_of(chain), [&](std::span<const EdgeOfChain> uses) {
        for_each_sector(chain, uses, [&](const EdgeOfChain& one, const EdgeOfChain& next, double) {
            // Seen against the edge, a triangle that traverses it faces counter-clockwise.
            sides.join(2 * one.triangle + (one.is_rising ? 0 : 1), 2 * next.triangle + (next.is_rising ? 1 : 0), 0);
        });
    });
    for (std::uint32_t t = 0; t < n; ++t) sides.join(2 * t, 2 * t + 1, chain.triangles[t].times);

    // The largest triangle of each set, on which a ray starts.
    std::vector<std::uint32_t> largest(2 * std::size_t{n}, n), starts;
    for (std::uint32_t t = 0; t < n; ++t) {
        std::uint32_t& of_set = largest[sides.root(2 * t).root];
        if (of_set == n || glm::length(chain.normal(t)) > glm::length(chain.normal(of_set))) of_set = t;
    }
    for (const std::uint32_t t : largest)
        if (t < n) starts.push_back(t);
    const ChainWinding winding(chain);
    std::vector<std::int64_t> found(starts.size());
    tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) { found[i] = winding.in_front_of(starts[i]); });
    std::vector<std::int64_t> at_root(2 * std::size_t{n}, 0);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const auto known = sides.root(2 * starts[i]);
        at_root[known.root] = found[i] - known.more;
    }
    std::vector<SideWinding> result(n);
    for (std::uint32_t t = 0; t < n; ++t) {
        const auto front = sides.root(2 * t), back = sides.root(2 * t + 1);
        result[t] = {at_root[front.root] + front.more, at_root[back.root] + back.more};
    }
    return result;
}

bool are_confirmed(const Chain& chain, std::span<const SideWinding> windings,
                   std::span<const std::uint32_t> triangles) {
    if (triangles.empty()) return true;
    constexpr double thin = 8 * touching;
    const ChainWinding winding(chain);
    std::atomic<bool> is_wrong = false;
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) {
        if (is_wrong) return;
        const std::uint32_t t = triangles[i];
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, glm::distance(chain.corner(t, k), chain.corner(t, (k + 1) % 3)));
        if (glm::length(chain.normal(t)) > thin * longest && winding.in_front_of(t) != windings[t].front)
            is_wrong = true;
    });
    return !is_wrong;
}

Chain boundary_of(const Chain& chain, std::span<const SideWinding> windings, WindingRule rule) {
    Chain boundary;
    boundary.step = chain.step;
    constexpr std::uint32_t unused = 0xffffffff;
    std::vector<std::uint32_t> number(chain.points.size(), unused);
    for (std::size_t t = 0; t < chain.triangles.size(); ++t) {
        const bool front = is_inside(windings[t].front, rule), back = is_inside(windings[t].back, rule);
        if (front == back) continue;
        ChainTriangle kept{chain.triangles[t].corners};
        if (front) std::swap(kept.corners[1], kept.corners[2]);
        boundary.triangles.push_back(kept);
        for (const std::uint32_t v : kept.corners) number[v] = 0;
    }
    // In ascending order of coordinates, as in any other surface.
    std::vector<std::uint32_t> used;
    for (std::uint32_t v = 0; v < number.size(); ++v)
        if (number[v] != unused) used.push_back(v);
    std::ranges::sort(used, [&](std::uint32_t a, std::uint32_t b) {
        const glm::dvec3 &p = chain.points[a], &q = chain.points[b];
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    });
    for (const std::uint32_t v : used) {
        number[v] = static_cast<std::uint32_t>(boundary.points.size());
        boundary.points.push_back(chain.points[v]);
    }
    for (ChainTriangle& t : boundary.triangles) {
        for (std::uint32_t& v : t.corners) v = number[v];
        std::rotate(t.corners.begin(), std::ranges::min_element(t.corners), t.corners.end());
    }
    std::ranges::sort(boundary.triangles, {}, &ChainTriangle::corners);
    return boundary;
}

Surface surface_of_boundary(const Chain& boundary) {
    Surface s;
    s.triangles.reserve(boundary.triangles.size());
    s.normals.reserve(boundary.triangles.size());
    s.edges.reserve(3 * boundary.triangles.size() / 2);
    for (const glm::dvec3& p : boundary.points) s.vertices.emplace_back(p * boundary.step);
    for (std::uint32_t t = 0; t < boundary.triangles.size(); ++t) {
        const auto& c = boundary.triangles[t].corners;
        s.triangles.push_back({c[0], c[1], c[2]});
        s.normals.push_back(glm::normalize(boundary.normal(t)));
    }
    for_each_edge(edges_of(boundary), [&](std::span<const EdgeOfChain> uses) {
        double widest = -1;
        SharedEdge edge{};
        for_each_sector(boundary, uses, [&](const EdgeOfChain& one, const EdgeOfChain& next, double angle) {
            if (angle <= widest) return;
            widest = angle;
            const bool is_first = one.is_rising;
            edge = {{one.low, one.high},
                    {is_first ? one.triangle : next.triangle, is_first ? next.triangle : one.triangle}};
        });
        s.edges.push_back(edge);
    });
    return s;
}

}  // namespace phasetree::mesh
