#pragma once

#include "phasetree/math/portable.hpp"
#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/mirrors.hpp"

namespace phasetree {

/// Mirrors fold the star to one sector (mirrors.hpp) with angles [0, π/n]. It has one edge, from the tip (R, 0) to the
/// notch r (cos π/n, sin π/n).
struct Star {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"star", "", "fold to one sector;  ± distance to its edge",
                                   "A star about the origin with a tip on the x axis, for extruding; the same at every "
                                   "z, exact."};
    float points = 5;
    float radius = 1;
    float inner_radius = 0.5f;
    detail::PolygonMirrors mirrors{};  ///< derived
    float edge_x = 0, edge_y = 0;      ///< from tip to notch, derived
    float edge_length = 1;             ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Star::points, Parameter{"points", "", "Number of tips.", Limits{.low = 3, .high = 64}});
        v(&Star::radius, Parameter{"radius", "m", "Distance of the tips from the centre.", limits::positive});
        v(&Star::inner_radius,
          Parameter{"inner_radius", "m", "Distance of the notches from the centre, less than that of the tips.",
                    limits::positive});
    }
    void prepare() {
        if (points != std::floor(points)) throw ModelError("star: \"points\" must be a whole number");
        if (!(inner_radius < radius)) throw ModelError("star: the inner radius must be less than the outer one");
        detail::require_usable(info.name, {radius, inner_radius});
        mirrors = detail::PolygonMirrors::of(points);
        const double step = 3.14159265358979323846 / static_cast<double>(points), r = inner_radius;
        const double x = r * std::cos(step) - radius, y = r * std::sin(step);
        edge_x = static_cast<float>(x);
        edge_y = static_cast<float>(y);
        edge_length = static_cast<float>(std::sqrt(x * x + y * y));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        T x = p.x, y = p.y;
        mirrors.fold(x, y);
        x = x - radius;
        const float unit_x = edge_x / edge_length, unit_y = edge_y / edge_length;
        const T along = clamp(x * unit_x + y * unit_y, T(0.f), T(edge_length));
        const T d = length(x - along * unit_x, y - along * unit_y);
        return select(less(x * unit_y, y * unit_x), -d, d);
    }
    double support(const glm::dvec3& d, float level) const {
        const double pi = 3.14159265358979323846, step = pi / static_cast<double>(points);
        const auto corners = [&](double shift) {
            return std::cos(std::remainder(portable::atan2(d.y, d.x) - shift, 2 * step)) * detail::disk_support(d);
        };
        return detail::section_support(
            d, std::max(corners(0) * static_cast<double>(radius), corners(step) * static_cast<double>(inner_radius)) +
                   detail::disk_support(d) * static_cast<double>(level));
    }
    Bounds bounds(BoundsQuery&, float level) const {
        Bounds b;
        for (int k = 0; k < 2 * static_cast<int>(points); ++k) {
            const double a = 3.14159265358979323846 * k / static_cast<double>(points);
            const double r = k % 2 == 0 ? radius : inner_radius;
            const glm::vec3 corner(r * std::cos(a), r * std::sin(a), 0);
            b = unite(b, {corner, corner});
        }
        return detail::at_every_height(b, 1e-6f * radius + level);
    }
};

}  // namespace phasetree
