#include "nodes/mesh_repair/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace phasetree::mesh {

namespace {

using Edge2 = std::array<std::uint32_t, 2>;  // in ascending order

Edge2 edge_of(const ChainTriangle& t, std::size_t i) {
    const std::uint32_t a = t.corners[i], b = t.corners[(i + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
}
bool has(const ChainTriangle& t, std::uint32_t v) {
    return t.corners[0] == v || t.corners[1] == v || t.corners[2] == v;
}
double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

// Whether a vertex touches an edge between its ends, such that both parts would be shorter than the edge.
bool touches_edge(const Chain& chain, std::uint32_t v, const Edge2& edge) {
    const glm::dvec3 &a = chain.points[edge[0]], &b = chain.points[edge[1]], &p = chain.points[v];
    const glm::dvec3 e = b - a, w = p - a;
    const double ee = squared(e), along = glm::dot(w, e);
    if (!(along > 0 && along < ee)) return false;
    return squared(glm::cross(w, e)) < touching * touching * ee && squared(w) < ee && squared(p - b) < ee;
}

// The lattice point nearest to p, or one of `vertices` if it is close.
glm::dvec3 lattice_point(const glm::dvec3& p, std::initializer_list<const glm::dvec3*> vertices) {
    for (const glm::dvec3* v : vertices)
        if (squared(*v - p) < 1) return *v;
    return glm::round(p) + 0.0;
}

// A triangle and its plane.
class Plane {
  public:
    Plane(const Chain& chain, std::uint32_t triangle)
        : chain_(chain), triangle_(triangle), n_(chain.normal(triangle)), length_(glm::length(n_)) {}

    bool is_flat() const { return length_ == 0; }
    double height(const glm::dvec3& p) const { return glm::dot(n_, p - chain_.corner(triangle_, 0)) / length_; }
    bool contains_foot_of(const glm::dvec3& p) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = chain_.corner(triangle_, i), &b = chain_.corner(triangle_, (i + 1) % 3);
            if (!(glm::dot(glm::cross(n_, b - a), p - a) > 0)) return false;
        }
        return true;
    }

  private:
    const Chain& chain_;
    std::uint32_t triangle_;
    glm::dvec3 n_;
    double length_;
};

class PairOfTriangles {
  public:
    PairOfTriangles(const Chain& chain, std::uint32_t one, std::uint32_t other, Contacts& found)
        : chain_(chain), found_(found), numbers_{one, other}, planes_{Plane(chain, one), Plane(chain, other)} {}

    void look() {
        for (const std::size_t side : {0u, 1u})
            if (is_on_one_side(side)) return;
        for (const std::size_t side : {0u, 1u})
            for (std::size_t i = 0; i < 3; ++i) touches_[side][i] = touches_triangle(side, i);
        std::array<std::array<bool, 3>, 2> meets{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (meet(i, k)) meets[0][i] = meets[1][k] = true;
        for (const std::size_t side : {0u, 1u})
            for (std::size_t i = 0; i < 3; ++i)
                if (!meets[side][i]) go_through(side, i);
        if (!points_.empty()) add_segments();
    }

  private:
    // A contact, and the edges of both triangles on which it is; the corners of a triangle are on two edges.
    struct PointOfContact {
        glm::dvec3 at;
        std::array<std::array<bool, 3>, 2> edges{};
    };
    void set_corner(PointOfContact& p, std::size_t side, std::size_t i) {
        p.edges[side][i] = p.edges[side][(i + 2) % 3] = true;
    }

    const ChainTriangle& triangle(std::size_t side) const { return chain_.triangles[numbers_[side]]; }
    const glm::dvec3& at(std::uint32_t v) const { return chain_.points[v]; }

    // Whether the corners of a triangle that are not shared lie on one side of the other's plane, and away from it.
    bool is_on_one_side(std::size_t side) const {
        const Plane& plane = planes_[1 - side];
        if (plane.is_flat()) return false;
        double low = 1e300, high = -1e300;
        for (const std::uint32_t v : triangle(side).corners) {
            if (has(triangle(1 - side), v)) continue;
            const double h = plane.height(at(v));
            low = std::min(low, h);
            high = std::max(high, h);
        }
        return low > touching || high < -touching;
    }
    // Whether a corner touches the other triangle.
    bool touches_triangle(std::size_t side, std::size_t i) {
        const std::uint32_t v = triangle(side).corners[i];
        const ChainTriangle& other = triangle(1 - side);
        if (has(other, v)) return false;
        for (std::size_t k = 0; k < 3; ++k)
            if (const Edge2 e = edge_of(other, k); touches_edge(chain_, v, e)) {
                found_.edges.push_back({e[0], e[1], at(v)});
                points_.push_back({at(v)});
                set_corner(points_.back(), side, i);
                points_.back().edges[1 - side][k] = true;
                return true;
            }
        const Plane& plane = planes_[1 - side];
        if (plane.is_flat() || !(std::abs(plane.height(at(v))) < touching) || !plane.contains_foot_of(at(v)))
            return false;
        found_.faces.push_back({numbers_[1 - side], at(v)});
        points_.push_back({at(v)});
        set_corner(points_.back(), side, i);
        return true;
    }
    // Whether two edges touch between their ends.
    bool meet(std::size_t i, std::size_t k) {
        Edge2 one = edge_of(triangle(0), i), other = edge_of(triangle(1), k);
        if (one[0] == other[0] || one[0] == other[1] || one[1] == other[0] || one[1] == other[1]) return false;
        if (other < one) std::swap(one, other);  // for the same result whichever triangles the edges were found in
        const glm::dvec3 &a = at(one[0]), &b = at(one[1]), &c = at(other[0]), &d = at(other[1]);
        const glm::dvec3 u = b - a, v = d - c, n = glm::cross(u, v);
        const double nn = squared(n), gap = glm::dot(n, c - a);
        if (nn == 0 || !(gap * gap < touching * touching * nn)) return false;
        const double s = glm::dot(glm::cross(c - a, v), n) / nn, t = glm::dot(glm::cross(c - a, u), n) / nn;
        if (!(s > 0 && s < 1 && t > 0 && t < 1)) return false;
        for (const std::uint32_t end : one)
            if (touches_edge(chain_, end, other)) return true;
        for (const std::uint32_t end : other)
            if (touches_edge(chain_, end, one)) return true;
        const glm::dvec3 p = lattice_point(0.5 * (a + s * u + c + t * v), {&a, &b, &c, &d});
        found_.edges.push_back({one[0], one[1], p});
        found_.edges.push_back({other[0], other[1], p});
        points_.push_back({p});
        points_.back().edges[0][i] = points_.back().edges[1][k] = true;
        return true;
    }
    // An edge of one side that goes through the inside of the other triangle.
    void go_through(std::size_t side, std::size_t i) {
        if (touches_[side][i] || touches_[side][(i + 1) % 3]) return;
        const Edge2 e = edge_of(triangle(side), i);
        const ChainTriangle& other = triangle(1 - side);
        const Plane& plane = planes_[1 - side];
        if (has(other, e[0]) || has(other, e[1]) || plane.is_flat()) return;
        const glm::dvec3 &a = at(e[0]), &b = at(e[1]);
        const double above = plane.height(a), below = plane.height(b);
        if (!(above * below < 0)) return;
        const glm::dvec3 p = a + above / (above - below) * (b - a);
        if (!plane.contains_foot_of(p)) return;
        const glm::dvec3 q =
            lattice_point(p, {&a, &b, &at(other.corners[0]), &at(other.corners[1]), &at(other.corners[2])});
        found_.edges.push_back({e[0], e[1], q});
        found_.faces.push_back({numbers_[1 - side], q});
        points_.push_back({q});
        points_.back().edges[side][i] = true;
    }

    // Triangles in one plane meet along the edges of both, others along a line.
    void add_segments() {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                if (triangle(0).corners[i] != triangle(1).corners[k]) continue;
                points_.push_back({at(triangle(0).corners[i])});
                set_corner(points_.back(), 0, i);
                set_corner(points_.back(), 1, k);
            }
        if (points_.size() < 2) return;
        if (is_in_plane(0) && is_in_plane(1)) {
            for (const std::size_t side : {0u, 1u})
                for (std::size_t i = 0; i < 3; ++i) {
                    std::vector<glm::dvec3> on_edge;
                    for (const PointOfContact& p : points_)
                        if (p.edges[side][i]) on_edge.push_back(p.at);
                    const Edge2 e = edge_of(triangle(side), i);
                    add_along(at(e[1]) - at(e[0]), std::move(on_edge), {1 - side});
                }
        } else {
            std::vector<glm::dvec3> all;
            for (const PointOfContact& p : points_) all.push_back(p.at);
            add_along(glm::cross(chain_.normal(numbers_[0]), chain_.normal(numbers_[1])), std::move(all), {0, 1});
        }
    }
    bool is_in_plane(std::size_t side) const {
        const Plane& plane = planes_[1 - side];
        return plane.is_flat() || std::ranges::all_of(triangle(side).corners, [&](std::uint32_t v) {
                   return std::abs(plane.height(at(v))) < 2 * touching;
               });
    }
    void add_along(const glm::dvec3& d, std::vector<glm::dvec3> points, std::initializer_list<std::size_t> sides) {
        std::ranges::sort(points, {}, [&](const glm::dvec3& p) { return std::tuple(glm::dot(p, d), p.x, p.y, p.z); });
        for (std::size_t i = 1; i < points.size(); ++i)
            if (points[i] != points[i - 1])
                for (const std::size_t side : sides)
                    found_.segments.push_back({numbers_[side], points[i - 1], points[i]});
    }

    const Chain& chain_;
    Contacts& found_;
    std::array<std::uint32_t, 2> numbers_;
    std::array<Plane, 2> planes_;
    std::array<std::array<bool, 3>, 2> touches_{};
    std::vector<PointOfContact> points_;
};

}  // namespace

void find_contacts(const Chain& chain, std::uint32_t one, std::uint32_t other, Contacts& found) {
    PairOfTriangles(chain, one, other, found).look();
}

void find_own_contact(const Chain& chain, std::uint32_t triangle, Contacts& found) {
    const ChainTriangle& t = chain.triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i) {
        const Edge2 e = edge_of(t, i);
        const std::uint32_t v = t.corners[(i + 2) % 3];
        if (!touches_edge(chain, v, e)) continue;
        found.edges.push_back({e[0], e[1], chain.points[v]});
        return;
    }
}

}  // namespace phasetree::mesh
