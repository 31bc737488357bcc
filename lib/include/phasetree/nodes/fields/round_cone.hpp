#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The convex hull of two balls of radii a and b at a distance l. Let x be a point's coordinate along the axis from the
/// first centre, and y its distance from the axis. The common tangent has the unit normal n = (s, c), s = (a − b)/l, c
/// = √(1 − s²), because the balls' supports along n, a + 0 and b + s l, are then equal. It touches the balls at a·n and
/// (l, 0) + b·n; along the tangent τ = (c, −s) these are at 0 and c·l. With k = c x − s y, the nearest boundary point
/// is on the first ball where k < 0, on the second where k > c l, and on the tangent in between.
struct RoundCone {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"round_cone", "",
                                   "k = c x − s y;  k < 0: |p − from| − a;  k > c l: |p − to| − b;  else s x + c y − a",
                                   "The convex hull of two balls; exact."};
    glm::vec3 from{0, 0, -1};
    float radius_from = 0.5f;
    glm::vec3 to{0, 0, 1};
    float radius_to = 0.25f;
    glm::vec3 axis{0, 0, 1};  ///< of unit length, derived
    float separation = 2;     ///< l, derived
    float sine = 0.125f;      ///< s, derived
    float cosine = 0.992f;    ///< c, derived

    template <class V>
    static void parameters(V&& v) {
        v(&RoundCone::from, Parameter{"from", "m", "Centre of one ball."});
        v(&RoundCone::radius_from, Parameter{"radius_from", "m", "Its radius.", limits::positive});
        v(&RoundCone::to, Parameter{"to", "m", "Centre of the other ball."});
        v(&RoundCone::radius_to, Parameter{"radius_to", "m", "Its radius.", limits::positive});
    }
    void prepare() {
        const glm::dvec3 along = glm::dvec3(to) - glm::dvec3(from);
        const double l = glm::length(along), s = (static_cast<double>(radius_from) - radius_to) / l;
        if (!(l > 0) || !(std::abs(s) < 1)) throw ModelError("round_cone: one of the balls contains the other");
        detail::require_usable(info.name, {radius_from, radius_to, static_cast<float>(l)});
        axis = glm::vec3(along / l);
        separation = static_cast<float>(l);
        sine = static_cast<float>(s);
        cosine = static_cast<float>(std::sqrt((1 - s) * (1 + s)));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const Vec3<T> q = p - from;
        const T x = dot(q, axis);
        const T y = length(Vec3<T>{q.x - x * axis.x, q.y - x * axis.y, q.z - x * axis.z});
        const T k = x * cosine - y * sine;
        const auto at_first = [&] { return length(q) - radius_from; };
        const auto at_second = [&] { return length(p - to) - radius_to; };
        const auto at_side = [&] { return x * sine + y * cosine - radius_from; };
        const auto behind = [&] { return choose_smoothly(less(T(cosine * separation), k), at_second, at_side); };
        return choose_smoothly(less(k, T(0.f)), at_first, behind);
    }
    /// The ball that touches the surface at the point has its centre at x − y s/c along the axis, and the radius a − s
    /// x + y s²/c. This is at least a − s x, whichever end is larger, and a − s x needs no square root.
    double rolling_radius(const glm::dvec3& p, double reach) const {
        const double x = glm::dot(p - glm::dvec3(from), glm::dvec3(axis)), s = sine;
        const double least = std::min(radius_from, radius_to);
        return std::max(least, radius_from - s * std::clamp(x, 0.0, double{separation}) - std::abs(s) * reach);
    }
    double support(const glm::dvec3& d, float level) const {
        const auto ball = [&](const glm::vec3& centre, float radius) {
            return glm::dot(d, glm::dvec3(centre)) +
                   glm::length(d) * static_cast<double>(radius + std::max(level, -radius));
        };
        return std::max(ball(from, radius_from), ball(to, radius_to));
    }
    Bounds bounds(BoundsQuery&, float level) const {
        return unite(Bounds{from, from}.inflated(radius_from + std::max(level, -radius_from)),
                     Bounds{to, to}.inflated(radius_to + std::max(level, -radius_to)));
    }
};

}  // namespace phasetree
