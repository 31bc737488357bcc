#pragma once

#include <vector>

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A round wire along a chain of segments: the union of capsules, but a single instruction. Exact outside; a bound
/// inside, where two capsules overlap.
struct Polyline {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"polyline", "", "min over segments ab of |p − a − t (b − a)| − r, t in [0, 1]",
                                   "A round wire along a chain of straight segments."};
    std::vector<glm::vec3> points{};
    float radius = 0.1f;
    std::vector<float> table{};  ///< derived: the number of segments, r, and for each segment a, b − a, 1/|b − a|²

    template <class V>
    static void parameters(V&& v) {
        v(&Polyline::points, Parameter{"points", "m", "The chain's points, at least two."});
        v(&Polyline::radius, Parameter{"radius", "m", "Radius of the wire.", limits::positive});
    }
    void prepare() {
        detail::require_usable(info.name, {radius});
        if (points.size() < 2) throw ModelError("polyline: at least two points are required");
        table = {static_cast<float>(points.size() - 1), radius};
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const glm::vec3 a = points[i], along = points[i + 1] - a;
            const float squared = glm::dot(along, along);
            if (!(glm::length(a) < 1e9f) || !(glm::length(points[i + 1]) < 1e9f))
                throw ModelError("polyline: its points must be within 1e9 m of the origin");
            // Two equal points give a ball.
            table.insert(table.end(), {a.x, a.y, a.z, along.x, along.y, along.z, squared > 1e-18f ? 1 / squared : 0.f});
        }
    }
    static constexpr unsigned half_instructions = 120;
    static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        const int segments = static_cast<int>(data[0]);
        const float r = data[1];
        T nearest(3.402823466e38f);
        for (const float *s = data + 2, *end = s + 7 * segments; s != end; s += 7) {
            const Vec3<T> q = p - glm::vec3(s[0], s[1], s[2]);
            const glm::vec3 along(s[3], s[4], s[5]);
            nearest = min(squared_distance_to_segment(q, along, s[6]), nearest);
        }
        return sqrt(nearest) - r;
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::hull_support(d, points) + glm::length(d) * static_cast<double>(radius + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        if (radius + level < 0) return {};
        Bounds b;
        for (const glm::vec3& p : points) b = unite(b, Bounds{p, p});
        return b.inflated(radius + level);
    }
};

}  // namespace phasetree
