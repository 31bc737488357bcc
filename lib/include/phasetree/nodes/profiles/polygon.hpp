#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/profiles/outline_in_box.hpp"

namespace phasetree {

/// The edges are straight pieces of an outline. For the equation see outline_pieces.hpp, for the data
/// outline_in_box.hpp.
struct Polygon {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"polygon", "", "± min over the edges of |p − a − clamp((p − a)·e/e², 0, 1) e|",
                                   "A polygon with straight edges, for extruding and revolving; the same at every z, "
                                   "exact."};
    static constexpr std::size_t max_points = 4096;
    std::vector<glm::vec2> points{};
    std::vector<float> table{};  ///< derived; the data of OutlineInBox

    template <class V>
    static void parameters(V&& v) {
        v(&Polygon::points, Parameter{"points", "m",
                                      "The corners [x, y] in order, in either direction, at most 4096. The last is "
                                      "joined to the first, and edges must not cross."});
    }
    void prepare() {
        if (points.size() > max_points) throw ModelError("polygon: more than 4096 points");
        points.erase(std::unique(points.begin(), points.end()), points.end());
        while (points.size() > 1 && points.front() == points.back()) points.pop_back();
        if (points.size() < 3) throw ModelError("polygon: at least three different points are required");
        for (const glm::vec2& v : points)
            if (std::abs(v.x) > 1e9f || std::abs(v.y) > 1e9f)
                throw ModelError("polygon: its points must be within 1e9 m of the origin");
        const std::size_t n = points.size();
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                if (cross_or_touch(i, j))
                    throw ModelError("polygon: the edges from its points " + std::to_string(i + 1) + " and " +
                                     std::to_string(j + 1) + " (not counting repeated points) cross or touch");
        table = {0.f, 0.f};
        std::size_t pieces = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const glm::dvec2 start(at(i)), end(at(i + 1));
            pieces += OutlinePieces::append({start, 0.5 * (start + end), end}, table);
        }
        table[0] = static_cast<float>(pieces);
    }
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        return OutlineInBox::distance(data, p);
    }
    using Specialised = OutlineInBox::Specialised;  // not in Polygon::Parts, because Bezier::Parts lists it and each
                                                    // type is listed once
    static constexpr unsigned search_half_instructions = 2000;
    static float spacing(const float* data) { return OutlineInBox::spacing(data); }
    static bool specialise(const float* data, const PointRange& range, std::span<const float> of,
                           std::vector<float>& floats) {
        return OutlineInBox::specialise(data, range, of, floats);
    }
    double support(const glm::dvec3& d, float level) const {
        double most = -std::numeric_limits<double>::infinity();
        for (const glm::vec2& v : points)
            most = std::max(most, d.x * static_cast<double>(v.x) + d.y * static_cast<double>(v.y));
        return detail::section_support(d, most + detail::disk_support(d) * static_cast<double>(level));
    }
    Bounds bounds(BoundsQuery&, float level) const {
        Bounds b;
        for (const glm::vec2& v : points) b = unite(b, {{v.x, v.y, 0}, {v.x, v.y, 0}});
        return detail::at_every_height(b, level);
    }

  private:
    glm::vec2 at(std::size_t i) const { return points[i % points.size()]; }
    /// Twice the signed area of a triangle.
    static double turn(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
        return (static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
               (static_cast<double>(b.y) - a.y) * (static_cast<double>(c.x) - a.x);
    }
    static bool within(const glm::vec2& a, const glm::vec2& b, const glm::vec2& p) {
        return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
               p.y <= std::max(a.y, b.y);
    }
    /// Consecutive edges share a point, and must not fold back onto each other.
    bool cross_or_touch(std::size_t i, std::size_t j) const {
        const glm::vec2 a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
        if (b == c) return turn(a, b, d) == 0 && (within(a, b, d) || within(c, d, a));
        if (d == a) return turn(c, d, b) == 0 && (within(c, d, b) || within(a, b, c));
        const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
        if (((c_side > 0 && d_side < 0) || (c_side < 0 && d_side > 0)) &&
            ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0)))
            return true;
        return (c_side == 0 && within(a, b, c)) || (d_side == 0 && within(a, b, d)) ||
               (a_side == 0 && within(c, d, a)) || (b_side == 0 && within(c, d, b));
    }
};

}  // namespace phasetree
