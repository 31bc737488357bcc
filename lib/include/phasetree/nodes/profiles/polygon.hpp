#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The distance is that to the nearest edge. A point is inside if a ray from it along +x crosses the outline an odd
/// number of times.
/// An edge counts for low ≤ y < high, with the same numbers where two edges meet; so a crossing is missed or counted
/// twice only where the side of an edge is a matter of rounding, on the outline itself.
struct Polygon {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"polygon", "", "± min over the edges of |p − a − clamp((p − a)·e/e², 0, 1) e|",
                                   "A polygon with straight edges, for extruding and revolving; the same at every z, "
                                   "exact."};
    static constexpr std::size_t most_points = 4096;
    std::vector<glm::vec2> points{};
    std::vector<float> table{};  ///< derived: the number of edges, and for each its start, vector, y of its end and 1
                                 ///< over the squared length

    template <class V>
    static void parameters(V&& v) {
        v(&Polygon::points, Parameter{"points", "m",
                                      "Its corners [x, y] in order, either way around; the last is joined to the "
                                      "first, and edges must not cross."});
    }
    void prepare() {
        if (points.size() > most_points) throw ModelError("polygon: more than 4096 points");
        points.erase(std::unique(points.begin(), points.end()), points.end());
        while (points.size() > 1 && points.front() == points.back()) points.pop_back();
        if (points.size() < 3) throw ModelError("polygon: it needs three different points");
        for (const glm::vec2& v : points)
            if (std::abs(v.x) > 1e9f || std::abs(v.y) > 1e9f)
                throw ModelError("polygon: its points must be within 1e9 m of the origin");
        const std::size_t n = points.size();
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                if (cross_or_touch(i, j))
                    throw ModelError("polygon: the edges from its points " + std::to_string(i + 1) + " and " +
                                     std::to_string(j + 1) + " cross or touch");
        table = {static_cast<float>(points.size())};
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec2 a = points[i], b = at(i + 1);
            const double x = static_cast<double>(b.x) - a.x, y = static_cast<double>(b.y) - a.y;
            table.insert(table.end(), {a.x, a.y, static_cast<float>(x), static_cast<float>(y), b.y,
                                       static_cast<float>(1 / (x * x + y * y))});
        }
    }
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        const T zero(0.f), one(1.f);
        T nearest(3e38f), sign(1.f);
        const int count = static_cast<int>(*data++);
        for (int i = 0; i < count; ++i, data += 6) {
            const float ex = data[2], ey = data[3], end = data[4];
            const T x = p.x - data[0], y = p.y - data[1];
            const T t = clamp((x * ex + y * ey) * data[5], zero, one);
            const T dx = x - t * ex, dy = y - t * ey;
            nearest = min(nearest, dx * dx + dy * dy);
            const T left = end > data[1] ? y * ex - x * ey : x * ey - y * ex;
            const float low = end > data[1] ? data[1] : end, high = end > data[1] ? end : data[1];
            const T crossed = select(less(zero, left), -sign, sign);
            sign = select(less(p.y, T(low)), sign, select(less(p.y, T(high)), crossed, sign));
        }
        return sqrt(nearest) * sign;
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
    /// Two edges that follow each other have a point in common, and must not turn back on each other.
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
