#pragma once

#include "phasetree/math/portable.hpp"
#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/mirrors.hpp"

namespace phasetree {

/// An extruded regular polygon with n sides. Its mirrors fold it to one sector (mirrors.hpp) with one edge, at x = R
/// cos(π/n), y from 0 to R sin(π/n).
struct Prism {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{
        "prism", "",
        "fold to one sector;  q = (polygon, |pz| − h/2);  "
        "|max(q, 0)| + min(max(qx, qy), 0)",
        "A prism about the z axis, whose base is a regular polygon with an edge perpendicular to the x axis; exact."};
    float sides = 6;
    float radius = 1;
    float height = 2;
    detail::PolygonMirrors mirrors{};  ///< derived
    float apothem = 0;                 ///< distance of the edges from the axis, derived
    float half_edge = 0;               ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Prism::sides, Parameter{"sides", "", "Number of sides of the polygon.", Limits{.low = 3, .high = 64}});
        v(&Prism::radius, Parameter{"radius", "m", "Radius of the circle through the corners.", limits::positive});
        v(&Prism::height, Parameter{"height", "m", "Whole height.", limits::positive});
    }
    void prepare() {
        if (sides != std::floor(sides)) throw ModelError("prism: \"sides\" must be a whole number");
        detail::require_usable(info.name, {radius, height});
        const double step = 3.14159265358979323846 / static_cast<double>(sides);
        mirrors = detail::PolygonMirrors::of(sides);
        apothem = static_cast<float>(static_cast<double>(radius) * std::cos(step));
        half_edge = static_cast<float>(static_cast<double>(radius) * std::sin(step));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        T x = p.x, y = p.y;
        mirrors.fold(x, y);
        // Inside, no point of the sector is beyond the edge's end.
        const T zero(0.f), side = x - apothem;
        const T polygon = length(max(side, zero), max(y - half_edge, zero)) + min(side, zero);
        return corner(polygon, abs(p.z) - height * 0.5f);
    }
    double support(const glm::dvec3& d, float level) const {
        // The corners are at odd multiples of π/n, so the nearest is at most π/n from the direction d.
        const double pi = 3.14159265358979323846, step = pi / static_cast<double>(sides);
        const double off = std::remainder(portable::atan2(d.y, d.x) - step, 2 * step);
        return detail::disk_support(d) * static_cast<double>(radius) * std::cos(off) +
               std::abs(d.z) * 0.5 * static_cast<double>(height) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        if (apothem + level < 0) return {};
        // The corners are at odd multiples of π/n.
        const int n = static_cast<int>(sides);
        const float left = n % 2 == 0 ? apothem : radius;
        const float side = n % 4 == 0 ? apothem : n % 2 == 0 ? radius : radius * std::cos(1.5707964f / sides);
        const glm::vec3 margin(1e-6f * radius, 1e-6f * radius, 0);
        return Bounds{glm::vec3(-left, -side, -height * 0.5f) - margin,
                      glm::vec3(apothem, side, height * 0.5f) + margin}
            .inflated(level);
    }
};

}  // namespace phasetree
