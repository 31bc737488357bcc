#include "phasetree/nodes/fields/joined_vertices.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>

#include "math/disjoint_sets.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree {

namespace {

using Indices = std::vector<std::uint32_t>;

std::tuple<float, float, float> coordinates(const glm::vec3& p) {
    return {p.x, p.y, p.z};
}

JoinedVertices join_equal(std::span<const glm::vec3> vertices) {
    Indices order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return coordinates(vertices[i]); };
    tbb::parallel_sort(order.begin(), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
    JoinedVertices joined{{}, Indices(vertices.size())};
    for (std::size_t i = 0; i < order.size(); ++i) {
        // Adding 0 turns −0 into 0, because the same point must have the same bits.
        if (i == 0 || key(order[i]) != key(order[i - 1])) joined.points.push_back(vertices[order[i]] + 0.f);
        joined.of[order[i]] = static_cast<std::uint32_t>(joined.points.size() - 1);
    }
    return joined;
}

// A triangle with two equal corners has no edges.
bool is_degenerate(const std::array<std::uint32_t, 3>& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}
std::array<std::uint32_t, 3> corners_of(const glm::uvec3& t, const Indices& of) {
    return {of[t.x], of[t.y], of[t.z]};
}

// The ends of edges shared by an odd number of triangles, in ascending order.
Indices ends_of_open_edges(std::span<const glm::uvec3> triangles, const Indices& of) {
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles) {
        const auto t = corners_of(triangle, of);
        if (is_degenerate(t)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            edges.push_back(std::uint64_t{low} << 32 | high);
        }
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    Indices ends;
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
        while (next < edges.size() && edges[next] == edges[i]) ++next;
        if ((next - i) % 2 == 0) continue;
        ends.push_back(static_cast<std::uint32_t>(edges[i] >> 32));
        ends.push_back(static_cast<std::uint32_t>(edges[i]));
    }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

// Two units in the last place of the largest coordinate.
double tolerance_of(std::span<const glm::vec3> points) {
    constexpr int bits_after_leading = 23;
    float largest = 0;
    for (const glm::vec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest > 0 ? std::ldexp(2.0, std::ilogb(largest) - bits_after_leading) : 0;
}

// Whether no coordinate of one box is farther than this from the other box.
bool are_near(const Bounds& a, const Bounds& b, double tolerance) {
    for (int k = 0; k < 3; ++k)
        if (double{a.low[k]} - double{b.high[k]} > tolerance || double{b.low[k]} - double{a.high[k]} > tolerance)
            return false;
    return true;
}
bool is_within(const Bounds& box, double size) {
    for (int k = 0; k < 3; ++k)
        if (double{box.high[k]} - double{box.low[k]} > size) return false;
    return true;
}

// Points in a grid whose cells are as wide as the tolerance, so that the points of a cell are near each other. Only
// neighbouring cells are compared, by the boxes around their points. Hence many points in one cell cost no more than a
// few.
class NearPoints {
  public:
    NearPoints(const std::vector<glm::vec3>& points, const Indices& candidates, double tolerance)
        : tolerance_(tolerance) {
        std::vector<std::pair<Cell, std::uint32_t>> placed;
        placed.reserve(candidates.size());
        for (const std::uint32_t i : candidates) placed.emplace_back(cell_of(points[i]), i);
        std::ranges::sort(placed);
        for (const auto& [cell, point] : placed) {
            if (cells_.empty() || cells_.back() != cell) {
                cells_.push_back(cell);
                first_.push_back(members_.size());
                boxes_.emplace_back();
            }
            members_.push_back(point);
            boxes_.back() = unite(boxes_.back(), {points[point], points[point]});
        }
        first_.push_back(members_.size());
    }

    // Groups of at least two points that are all near each other and near no others. The indices in each group are in
    // ascending order.
    std::vector<Indices> groups() const {
        DisjointSets sets(cells_.size());
        for (std::size_t c = 0; c < cells_.size(); ++c) join_neighbours(c, sets);
        std::vector<Bounds> boxes = boxes_;
        for (std::size_t c = 0; c < cells_.size(); ++c) boxes[sets.root(c)] = unite(boxes[sets.root(c)], boxes_[c]);
        std::vector<Indices> of_root(cells_.size());
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            const std::size_t root = sets.root(c);
            if (is_within(boxes[root], tolerance_))
                of_root[root].insert(of_root[root].end(), begin_of(c), begin_of(c + 1));
        }
        std::erase_if(of_root, [](const Indices& group) { return group.size() < 2; });
        for (Indices& group : of_root) std::ranges::sort(group);
        return of_root;
    }

  private:
    using Cell = std::array<std::int32_t, 3>;

    Cell cell_of(const glm::vec3& p) const {
        Cell cell;
        for (int k = 0; k < 3; ++k)
            cell[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::floor(double{p[k]} / tolerance_));
        return cell;
    }
    Indices::const_iterator begin_of(std::size_t cell) const {
        return members_.begin() + static_cast<std::ptrdiff_t>(first_[cell]);
    }
    void join_neighbours(std::size_t c, DisjointSets& sets) const {
        for (int n = 0; n < 27; ++n) {
            const Cell beside{cells_[c][0] + n / 9 - 1, cells_[c][1] + n / 3 % 3 - 1, cells_[c][2] + n % 3 - 1};
            if (!(beside < cells_[c])) continue;  // visit each pair of cells once
            const auto found = std::ranges::lower_bound(cells_, beside);
            if (found == cells_.end() || *found != beside) continue;
            const auto other = static_cast<std::size_t>(found - cells_.begin());
            if (are_near(boxes_[c], boxes_[other], tolerance_)) sets.join(c, other);
        }
    }

    double tolerance_;
    std::vector<Cell> cells_;         // cells with points, in ascending order
    std::vector<std::size_t> first_;  // the start of each cell in `members_`, and the end
    Indices members_;                 // the points, cell by cell
    std::vector<Bounds> boxes_;       // around the points of each cell
};

// For each point, the point that replaces it.
Indices targets_of(const std::vector<glm::vec3>& points, const std::vector<Indices>& groups) {
    Indices target(points.size());
    std::iota(target.begin(), target.end(), 0u);
    const auto distance = [&](std::uint32_t i) { return glm::length(glm::dvec3(points[i])); };
    for (const Indices& group : groups) {
        const std::uint32_t nearest = *std::ranges::min_element(group, {}, distance);
        for (const std::uint32_t i : group) target[i] = nearest;
    }
    return target;
}

Indices after(const Indices& target, Indices of) {
    for (std::uint32_t& i : of) i = target[i];
    return of;
}

// What happens to triangles with corners in a group, by the point that replaces the group.
struct Effects {
    std::vector<bool> collapses;  // a triangle degenerates, because two of its corners are joined
    std::vector<bool> remains;    // a triangle keeps its area
};
Effects effects_of(std::span<const glm::uvec3> triangles, const Indices& of, const Indices& target) {
    Effects effects{std::vector<bool>(target.size(), false), std::vector<bool>(target.size(), false)};
    for (const glm::uvec3& triangle : triangles) {
        const auto before = corners_of(triangle, of);
        if (is_degenerate(before)) continue;
        const std::array<std::uint32_t, 3> t{target[before[0]], target[before[1]], target[before[2]]};
        for (std::size_t i = 0; i < 3; ++i) {
            if (t[i] == t[(i + 1) % 3]) effects.collapses[t[i]] = true;
            if (!is_degenerate(t)) effects.remains[t[i]] = true;
        }
    }
    return effects;
}

// Moves the vertices to the points that replace theirs, and removes points without vertices.
void move_to(const Indices& target, JoinedVertices& joined) {
    joined.of = after(target, std::move(joined.of));
    Indices place(target.size());
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < target.size(); ++i) {
        if (target[i] != i) continue;
        joined.points[count] = joined.points[i];
        place[i] = count++;
    }
    joined.points.resize(count);
    joined.of = after(place, std::move(joined.of));
}

}  // namespace

JoinedVertices join_vertices(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles) {
    JoinedVertices joined = join_equal(vertices);
    const Indices open = ends_of_open_edges(triangles, joined.of);
    if (open.empty()) return joined;
    std::vector<Indices> groups = NearPoints(joined.points, open, tolerance_of(joined.points)).groups();
    if (groups.empty()) return joined;
    const Indices target = targets_of(joined.points, groups);
    const Effects effects = effects_of(triangles, joined.of, target);
    // A part that would vanish completely is small rather than inexact, so keep it.
    std::erase_if(groups, [&](const Indices& group) { return !effects.remains[target[group[0]]]; });
    if (!ends_of_open_edges(triangles, after(targets_of(joined.points, groups), joined.of)).empty())
        std::erase_if(groups, [&](const Indices& group) { return effects.collapses[target[group[0]]]; });
    move_to(targets_of(joined.points, groups), joined);
    return joined;
}

}  // namespace phasetree
