#include "nodes/mesh_repair/holes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <tuple>

namespace phasetree::mesh {

namespace {

using Loop = std::vector<std::uint32_t>;  // of vertices, as a patch traverses them

// An edge that a patch has to traverse from one vertex to the other.
struct OpenEdge {
    std::uint32_t shell, from, to;
    auto operator<=>(const OpenEdge&) const = default;
};

std::vector<OpenEdge> open_edges(const Chain& chain, std::span<const EdgeOfChain> edges,
                                 std::span<const std::uint32_t> shells) {
    std::vector<OpenEdge> open;
    for_each_edge(edges, [&](std::span<const EdgeOfChain> uses) {
        int balance = 0;
        for (const EdgeOfChain& e : uses) balance += (e.is_rising ? 1 : -1) * chain.triangles[e.triangle].times;
        const EdgeOfChain& e = uses[0];
        for (; balance > 0; --balance) open.push_back({shells[e.triangle], e.high, e.low});
        for (; balance < 0; ++balance) open.push_back({shells[e.triangle], e.low, e.high});
    });
    std::ranges::sort(open);
    return open;
}

// Divides the edges of one shell into loops that visit no vertex twice. As many edges enter each vertex as leave it.
std::vector<Loop> loops_of(std::span<const OpenEdge> open, std::vector<std::uint32_t>& place) {
    std::vector<Loop> loops;
    std::vector<char> is_used(open.size(), 0);
    const auto next_from = [&](std::uint32_t vertex) {
        auto i = static_cast<std::size_t>(std::ranges::lower_bound(open, vertex, {}, &OpenEdge::from) - open.begin());
        while (i < open.size() && open[i].from == vertex && is_used[i]) ++i;
        return i < open.size() && open[i].from == vertex ? i : open.size();
    };
    constexpr std::uint32_t nowhere_yet = 0xffffffff;
    for (std::size_t first = 0; first < open.size(); ++first) {
        if (is_used[first]) continue;
        Loop path{open[first].from};
        place[path[0]] = 0;
        for (std::size_t e = first; e < open.size();) {
            is_used[e] = 1;
            const std::uint32_t to = open[e].to;
            if (place[to] != nowhere_yet) {
                const auto begin = path.begin() + place[to];
                loops.emplace_back(begin, path.end());
                for (auto v = begin + 1; v != path.end(); ++v) place[*v] = nowhere_yet;
                path.erase(begin + 1, path.end());
            } else {
                place[to] = static_cast<std::uint32_t>(path.size());
                path.push_back(to);
            }
            e = next_from(to);
        }
        for (const std::uint32_t v : path) place[v] = nowhere_yet;
    }
    return loops;
}

// Cuts a loop into triangles. In whatever order ears are cut off, the triangles' boundary is the loop. Ears without
// other vertices inside and with a short diagonal are preferred.
class EarClipping {
  public:
    EarClipping(const Chain& chain, const Loop& loop) : loop_(loop), at_(loop.size()) {
        const std::size_t n = loop.size();
        glm::dvec3 area(0);
        const glm::dvec3 origin = chain.points[loop[0]];
        for (std::size_t i = 0; i < n; ++i)
            area += glm::cross(chain.points[loop[i]] - origin, chain.points[loop[(i + 1) % n]] - origin);
        const double length = glm::length(area);
        const glm::dvec3 up = length > 0 ? area / length : glm::dvec3(0, 0, 1);
        const glm::dvec3 other = std::abs(up.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 x = glm::normalize(glm::cross(other, up)), y = glm::cross(up, x);
        for (std::size_t i = 0; i < n; ++i) {
            const glm::dvec3 p = chain.points[loop[i]] - origin;
            at_[i] = {glm::dot(x, p), glm::dot(y, p)};
        }
    }
    std::vector<ChainTriangle> operator()() {
        const std::size_t n = loop_.size();
        before_.resize(n), after_.resize(n), cost_.resize(n);
        for (std::size_t i = 0; i < n; ++i) before_[i] = (i + n - 1) % n, after_[i] = (i + 1) % n;
        for (std::size_t i = 0; i < n; ++i) cost_[i] = cost(i);
        std::vector<ChainTriangle> triangles;
        std::size_t left = n, start = 0;
        for (; left > 3; --left) {
            std::size_t best = start;
            for (std::size_t i = after_[start]; i != start; i = after_[i])
                if (cost_[i] < cost_[best]) best = i;
            triangles.push_back({{loop_[before_[best]], loop_[best], loop_[after_[best]]}});
            const std::size_t a = before_[best], b = after_[best];
            after_[a] = b, before_[b] = a;
            cost_[a] = cost(a), cost_[b] = cost(b);
            start = a;
        }
        triangles.push_back({{loop_[before_[start]], loop_[start], loop_[after_[start]]}});
        return triangles;
    }

  private:
    static double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }
    double cost(std::size_t i) const {
        const glm::dvec2 &a = at_[before_[i]], &b = at_[i], &c = at_[after_[i]];
        const double squared = glm::dot(c - a, c - a);
        constexpr double bad = 1e30;
        if (!(turn(a, b, c) > 0)) return bad + squared;
        for (std::size_t k = after_[after_[i]]; k != before_[i]; k = after_[k])
            if (turn(a, b, at_[k]) >= 0 && turn(b, c, at_[k]) >= 0 && turn(c, a, at_[k]) >= 0) return bad + squared;
        return squared;
    }

    const Loop& loop_;
    std::vector<glm::dvec2> at_;
    std::vector<std::size_t> before_, after_;
    std::vector<double> cost_;
};

// Triangles from the middle of a loop, which is too long to be cut ear by ear.
void add_cone(Chain& chain, const Loop& loop, std::vector<ChainTriangle>& triangles) {
    glm::dvec3 sum(0);
    for (const std::uint32_t v : loop) sum += chain.points[v];
    const auto apex = static_cast<std::uint32_t>(chain.points.size());
    chain.points.push_back(glm::round(sum / static_cast<double>(loop.size())) + 0.0);
    for (std::size_t i = 0; i < loop.size(); ++i) triangles.push_back({{loop[i], loop[(i + 1) % loop.size()], apex}});
}

double area_of(const Chain& chain, const ChainTriangle& t) {
    const glm::dvec3& a = chain.points[t.corners[0]];
    return glm::length(glm::cross(chain.points[t.corners[1]] - a, chain.points[t.corners[2]] - a));
}

}  // namespace

ClosedHoles close_holes(Chain& chain, std::span<const EdgeOfChain> edges, std::vector<std::uint32_t>& shells) {
    constexpr std::size_t longest_for_ears = 20'000;
    ClosedHoles result;
    const std::vector<OpenEdge> open = open_edges(chain, edges, shells);
    if (open.empty()) return result;
    std::uint32_t count = 0;
    for (const std::uint32_t s : shells) count = std::max(count, s + 1);
    std::vector<double> area(count, 0);
    for (std::size_t t = 0; t < shells.size(); ++t) area[shells[t]] += area_of(chain, chain.triangles[t]);
    std::vector<char> is_sheet(count, 0);
    std::vector<std::uint32_t> place(chain.points.size(), 0xffffffff);
    for (std::size_t i = 0, end = 0; i < open.size(); i = end) {
        while (end < open.size() && open[end].shell == open[i].shell) ++end;
        const std::uint32_t shell = open[i].shell;
        std::vector<ChainTriangle> patch;
        const std::vector<Loop> loops = loops_of(std::span(open).subspan(i, end - i), place);
        for (const Loop& loop : loops) {
            if (loop.size() > longest_for_ears) {
                add_cone(chain, loop, patch);
            } else if (loop.size() >= 3) {
                const std::vector<ChainTriangle> ears = EarClipping(chain, loop)();
                patch.insert(patch.end(), ears.begin(), ears.end());
            }
        }
        double patch_area = 0;
        for (const ChainTriangle& t : patch) patch_area += area_of(chain, t);
        result.holes += loops.size();
        if (patch_area > largest_patch * area[shell]) {
            is_sheet[shell] = 1;
            ++result.sheets;
            continue;
        }
        chain.triangles.insert(chain.triangles.end(), patch.begin(), patch.end());
        shells.resize(chain.triangles.size(), shell);
    }
    if (result.sheets == 0) return result;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < shells.size(); ++t)
        if (!is_sheet[shells[t]]) {
            chain.triangles[kept] = chain.triangles[t];
            shells[kept++] = shells[t];
        }
    chain.triangles.resize(kept);
    shells.resize(kept);
    return result;
}

}  // namespace phasetree::mesh
