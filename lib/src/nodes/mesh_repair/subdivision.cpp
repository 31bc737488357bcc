#include "nodes/mesh_repair/subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace phasetree::mesh {

Subdivision::Subdivision(std::span<const glm::dvec3> points, const Corners& corners) : points_(points) {
    const glm::dvec3 a = points[corners[0]];
    const glm::dvec3 n = glm::cross(points[corners[1]] - a, points[corners[2]] - a), size = glm::abs(n);
    const int up = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    x_axis_ = (up + 1) % 3;
    y_axis_ = (up + 2) % 3;
    if (n[up] < 0) std::swap(x_axis_, y_axis_);
    for (std::size_t i = 0; i < 3; ++i) add(corners[i], side_bit(i) | side_bit((i + 2) % 3));
    write(0, {{0, 1, 2}, {none, none, none}});
}

void Subdivision::add_on_side(std::size_t side, std::span<const std::uint32_t> vertices) {
    const int end = static_cast<int>((side + 1) % 3);
    int from = static_cast<int>(side);
    for (const std::uint32_t v : vertices) {
        // The triangle on the remaining part of the side.
        int triangle = static_cast<int>(small_.size()) - 1;
        std::size_t of_triangle = 3;
        for (; of_triangle == 3; --triangle)
            for (std::size_t i = 0; i < 3; ++i)
                if (at(triangle).corners[i] == from && at(triangle).corners[(i + 1) % 3] == end) of_triangle = i;
        const int added = add(v, side_bit(side));
        split_side(triangle + 1, of_triangle, added);
        from = added;
    }
    flip_while_needed();
}

void Subdivision::add_within(std::uint32_t vertex) {
    const int v = add(vertex, 0);
    const int triangle = containing(v);
    const Small& t = at(triangle);
    for (std::size_t i = 0; i < 3; ++i)
        if (t.neighbours[i] != none && turn(t.corners[i], t.corners[(i + 1) % 3], v) == 0) {
            split_side(triangle, i, v);
            flip_while_needed();
            return;
        }
    split_face(triangle, v);
    flip_while_needed();
}

std::vector<Subdivision::Corners> Subdivision::triangles() const {
    std::vector<Corners> result(small_.size());
    for (std::size_t t = 0; t < small_.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) result[t][i] = vertices_[static_cast<std::size_t>(small_[t].corners[i])];
    return result;
}

glm::dvec2 Subdivision::projected(std::uint32_t vertex) const {
    return {points_[vertex][x_axis_], points_[vertex][y_axis_]};
}

int Subdivision::add(std::uint32_t vertex, unsigned sides) {
    vertices_.push_back(vertex);
    sides_.push_back(sides);
    xy_.push_back(projected(vertex));
    at_vertex_.push_back(0);
    return static_cast<int>(vertices_.size()) - 1;
}

// Positive for a left turn. Exact, because coordinates are whole numbers of 24 bits.
double Subdivision::turn(int a, int b, int c) const {
    const glm::dvec2 &p = xy_[static_cast<std::size_t>(a)], &q = xy_[static_cast<std::size_t>(b)],
                     &r = xy_[static_cast<std::size_t>(c)];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// Whether the edge from a to b, with c on its left and d on its right, should be flipped to go from c to d. This is so
// if d is inside the circle through the others, or on it while the lowest vertex is c or d.
bool Subdivision::should_flip(int a, int b, int c, int d) const {
    const glm::dvec2& origin = xy_[static_cast<std::size_t>(d)];
    const glm::dvec2 p = xy_[static_cast<std::size_t>(a)] - origin, q = xy_[static_cast<std::size_t>(b)] - origin,
                     r = xy_[static_cast<std::size_t>(c)] - origin;
    const double pp = glm::dot(p, p), qq = glm::dot(q, q), rr = glm::dot(r, r);
    const double sum = pp * (q.x * r.y - q.y * r.x) + qq * (r.x * p.y - r.y * p.x) + rr * (p.x * q.y - p.y * q.x);
    const double error = 1e-13 * (pp * std::sqrt(qq * rr) + qq * std::sqrt(rr * pp) + rr * std::sqrt(pp * qq));
    if (std::abs(sum) > error) return sum > 0;
    const auto number = [&](int v) { return vertices_[static_cast<std::size_t>(v)]; };
    return std::min(number(c), number(d)) < std::min(number(a), number(b));
}

// The side of a triangle from a to b. Two triangles may share two sides, so a neighbour does not determine its side.
std::size_t Subdivision::side_from(int triangle, int a, int b) const {
    const auto& c = at(triangle).corners;
    for (std::size_t i = 0; i < 3; ++i)
        if (c[i] == a && c[(i + 1) % 3] == b) return i;
    throw Tangled();
}

void Subdivision::set_neighbour(int triangle, int a, int b, int neighbour) {
    if (triangle != none) at(triangle).neighbours[side_from(triangle, a, b)] = neighbour;
}

// The triangle that contains a vertex, or one close to it.
int Subdivision::containing(int vertex) const {
    int t = last_;
    for (std::size_t steps = 0; steps < small_.size() + 3; ++steps) {
        int next = none;
        for (std::size_t i = 0; i < 3 && next == none; ++i)
            if (turn(at(t).corners[i], at(t).corners[(i + 1) % 3], vertex) < 0) next = at(t).neighbours[i];
        if (next == none) return t;
        t = next;
    }
    return t;
}

void Subdivision::split_face(int triangle, int vertex) {
    const auto [a, b, c] = at(triangle).corners;
    const auto [ab, bc, ca] = at(triangle).neighbours;
    const int second = static_cast<int>(small_.size()), third = second + 1;
    write(triangle, {{a, b, vertex}, {ab, second, third}});
    write(second, {{b, c, vertex}, {bc, third, triangle}});
    write(third, {{c, a, vertex}, {ca, triangle, second}});
    set_neighbour(bc, c, b, second);
    set_neighbour(ca, a, c, third);
    for (const int t : {triangle, second, third}) doubtful_.push_back({t, 0});
    last_ = triangle;
}

void Subdivision::split_side(int triangle, std::size_t side, int vertex) {
    // The halves of a triangle (a, b, c) with the vertex between a and b: (a, vertex, c) and (vertex, b, c).
    const auto halve = [&](int t, std::size_t i, int second) {
        const Small old = at(t);
        const int a = old.corners[i], b = old.corners[(i + 1) % 3], c = old.corners[(i + 2) % 3];
        const int bc = old.neighbours[(i + 1) % 3], ca = old.neighbours[(i + 2) % 3];
        write(t, {{a, vertex, c}, {none, second, ca}});
        write(second, {{vertex, b, c}, {none, bc, t}});
        set_neighbour(bc, c, b, second);
        for (const auto& [half, j] :
             {std::pair(t, 0), std::pair(t, 1), std::pair(t, 2), std::pair(second, 0), std::pair(second, 1)})
            doubtful_.push_back({half, j});
    };
    const int other = at(triangle).neighbours[side], second = static_cast<int>(small_.size());
    const auto& corners = at(triangle).corners;
    const std::size_t back = other == none ? 0 : side_from(other, corners[(side + 1) % 3], corners[side]);
    halve(triangle, side, second);
    last_ = triangle;
    if (other == none) return;
    const int fourth = second + 1;
    halve(other, back, fourth);
    // `triangle` has a, as `fourth` has; `second` has b, as `other` has.
    at(triangle).neighbours[0] = fourth;
    at(fourth).neighbours[0] = triangle;
    at(second).neighbours[0] = other;
    at(other).neighbours[0] = second;
}

void Subdivision::write(int triangle, const Small& small) {
    if (static_cast<std::size_t>(triangle) == small_.size()) small_.emplace_back();
    at(triangle) = small;
    for (const int v : small.corners) at_vertex_[static_cast<std::size_t>(v)] = triangle;
}

// Replaces the side from a to b, of triangles (a, b, c) and (b, a, d), by one from c to d.
void Subdivision::flip(int t, std::size_t i) {
    const int u = at(t).neighbours[i];
    const int a = at(t).corners[i], b = at(t).corners[(i + 1) % 3], c = at(t).corners[(i + 2) % 3];
    const std::size_t j = side_from(u, b, a);
    const int d = at(u).corners[(j + 2) % 3];
    const int bc = at(t).neighbours[(i + 1) % 3], ca = at(t).neighbours[(i + 2) % 3];
    const int ad = at(u).neighbours[(j + 1) % 3], db = at(u).neighbours[(j + 2) % 3];
    write(t, {{a, d, c}, {ad, u, ca}});
    write(u, {{d, b, c}, {db, bc, t}});
    set_neighbour(ad, d, a, t);
    set_neighbour(bc, c, b, u);
    for (const auto& [of, k] : {std::pair(t, 0), std::pair(t, 2), std::pair(u, 0), std::pair(u, 1)})
        doubtful_.push_back({of, k});
}

void Subdivision::flip_while_needed() {
    // Flipping terminates by itself, except perhaps for flips that undo what rounding has turned over. The limit is for
    // these.
    for (std::size_t left = 100 + 20 * small_.size(); !doubtful_.empty() && left > 0; --left) {
        const auto [t, side] = doubtful_.back();
        doubtful_.pop_back();
        const auto i = static_cast<std::size_t>(side);
        const int u = at(t).neighbours[i];
        if (u == none) continue;
        const int a = at(t).corners[i], b = at(t).corners[(i + 1) % 3], c = at(t).corners[(i + 2) % 3];
        const int d = at(u).corners[(side_from(u, b, a) + 2) % 3];
        if (is_fixed(a, b) || are_on_one_side(c, d) || !(turn(a, d, c) > 0 && turn(d, b, c) > 0)) continue;
        const bool is_turned_over = !(turn(a, b, c) > 0 && turn(b, a, d) > 0);
        if (is_turned_over || should_flip(a, b, c, d)) flip(t, i);
    }
    doubtful_.clear();
}

int Subdivision::index_of(std::uint32_t vertex) const {
    return static_cast<int>(std::ranges::find(vertices_, vertex) - vertices_.begin());
}

void Subdivision::add_segment(std::uint32_t from, std::uint32_t to) {
    const int a = index_of(from), b = index_of(to), end = static_cast<int>(vertices_.size());
    if (a == end || b == end || a == b) return;
    constexpr int most_parts = 1000;
    connect(a, b, most_parts);
    flip_while_needed();
}

// Calls f(triangle, i) for the triangles around a vertex, which is their corner i, until it returns true. Throws
// Tangled if they do not close a circle.
template <class F>
void Subdivision::for_each_around(int vertex, const F& f) const {
    std::size_t left = small_.size();
    const auto corner = [&](int t) {
        std::size_t i = 0;
        while (i < 2 && at(t).corners[i] != vertex) ++i;
        return i;
    };
    const int start = at_vertex_[static_cast<std::size_t>(vertex)];
    int t = start;
    do {
        if (f(t, corner(t))) return;
        t = at(t).neighbours[(corner(t) + 2) % 3];
        if (left-- == 0) throw Tangled();
    } while (t != none && t != start);
    if (t == start) return;
    for (t = at(start).neighbours[corner(start)]; t != none; t = at(t).neighbours[corner(t)]) {
        if (f(t, corner(t))) return;
        if (left-- == 0) throw Tangled();
    }
}

std::optional<Subdivision::Side> Subdivision::find_side(int a, int b) const {
    std::optional<Side> found;
    for_each_around(a, [&](int t, std::size_t i) {
        if (at(t).corners[(i + 1) % 3] == b) found = Side{t, i};
        if (at(t).corners[(i + 2) % 3] == b) found = Side{t, (i + 2) % 3};
        return found.has_value();
    });
    return found;
}

// Whether the segment between two vertices passes through another one, within rounding.
bool Subdivision::is_passed(int from, int to, int vertex) const {
    if (vertex == from || vertex == to) return false;
    const glm::dvec2 a = xy_[static_cast<std::size_t>(from)], e = xy_[static_cast<std::size_t>(to)] - a,
                     w = xy_[static_cast<std::size_t>(vertex)] - a;
    const double along = glm::dot(w, e), ee = glm::dot(e, e), off = turn(from, to, vertex);
    return along > 0 && along < ee && off * off < 2 * ee && glm::dot(w, w) < ee && glm::dot(w - e, w - e) < ee;
}

Subdivision::Way Subdivision::way_between(int from, int to) const {
    Way way;
    std::optional<Side> crossed;
    for_each_around(from, [&](int t, std::size_t i) {
        const int right = at(t).corners[(i + 1) % 3], left = at(t).corners[(i + 2) % 3];
        for (const int v : {right, left})
            if (is_passed(from, to, v)) way.passed = v;
        if (turn(from, to, right) < 0 && turn(from, to, left) > 0) crossed = Side{t, (i + 1) % 3};
        return way.passed != none;
    });
    if (way.passed != none) return way;
    way.is_free = crossed.has_value();
    for (std::size_t steps = 0; way.is_free; ++steps) {
        const int right = at(crossed->triangle).corners[crossed->side];
        const int left = at(crossed->triangle).corners[(crossed->side + 1) % 3];
        const int u = at(crossed->triangle).neighbours[crossed->side];
        way.is_free = u != none && !is_fixed(left, right) && steps < small_.size();
        if (!way.is_free) return way;
        way.crossed.emplace_back(left, right);
        const std::size_t j = side_from(u, left, right);
        const int apex = at(u).corners[(j + 2) % 3];
        if (apex == to) return way;
        if (is_passed(from, to, apex)) {
            way.passed = apex;
            return way;
        }
        crossed = Side{u, (turn(from, to, apex) > 0 ? j + 1 : j + 2) % 3};
    }
    return way;
}

// Sloan, "A Fast Algorithm for Generating Constrained Delaunay Triangulations" (1993).
void Subdivision::flip_crossed(int from, int to, std::vector<std::pair<int, int>> crossed) {
    std::size_t left = 100 + 10 * crossed.size() * crossed.size();
    for (std::size_t next = 0; next < crossed.size() && left > 0; ++next, --left) {
        const auto [p, q] = crossed[next];
        const auto side = find_side(p, q);
        if (!side) continue;
        const int t = side->triangle, u = at(t).neighbours[side->side];
        if (u == none) return;
        const int a = at(t).corners[side->side], b = at(t).corners[(side->side + 1) % 3],
                  c = at(t).corners[(side->side + 2) % 3], d = at(u).corners[(side_from(u, b, a) + 2) % 3];
        if (are_on_one_side(c, d) || !(turn(a, d, c) > 0 && turn(d, b, c) > 0)) {
            crossed.emplace_back(p, q);
            continue;
        }
        flip(t, side->side);
        const bool is_end = c == from || c == to || d == from || d == to;
        if (!is_end && turn(from, to, c) * turn(from, to, d) < 0) crossed.emplace_back(c, d);
    }
}

void Subdivision::connect(int from, int to, int most_parts) {
    if (most_parts == 0 || are_on_one_side(from, to)) return;
    if (!find_side(from, to)) {
        const Way way = way_between(from, to);
        if (way.passed != none) {
            connect(from, way.passed, most_parts - 1);
            connect(way.passed, to, most_parts - 1);
            return;
        }
        if (!way.is_free) return;
        flip_crossed(from, to, way.crossed);
        if (!find_side(from, to)) return;
    }
    fixed_.insert({std::min(from, to), std::max(from, to)});
}

}  // namespace phasetree::mesh
