#pragma once

#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A regular polygon of n sides, extruded. Its symmetry group has mirrors at the angles kπ/n. |y| leaves the angles
/// [0, nπ/n]; where [0, mπ/n] is left, the mirror at kπ/n, k = ⌈m/2⌉, maps [kπ/n, mπ/n] into [0, kπ/n]. After ⌈log₂ n⌉
/// such reflections [0, π/n] is left. They are isometries that map the polygon onto itself, and a point and its nearest
/// boundary point are on the same side of each mirror, so distances are kept. What is left has one edge, at
/// x = R cos(π/n), y from 0 to R sin(π/n).
struct Prism {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"prism", "",
                                   "fold to one sector;  q = (polygon, |pz| − h/2);  "
                                   "|max(q, 0)| + min(max(qx, qy), 0)",
                                   "A prism about the z axis on a regular polygon with an edge across the x axis; "
                                   "exact."};
    static constexpr int most_folds = 6;
    float sides = 6;
    float radius = 1;
    float height = 2;
    float folds = 0;  ///< how many of the mirrors below are used, derived
    float cosine[most_folds] = {};
    float sine[most_folds] = {};
    float apothem = 0;    ///< the edge's distance from the axis, derived
    float half_edge = 0;  ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Prism::sides, Parameter{"sides", "", "Sides of the polygon, a whole number.", Limits{.low = 3, .high = 64}});
        v(&Prism::radius, Parameter{"radius", "m", "Radius of the circle through the corners.", limits::positive});
        v(&Prism::height, Parameter{"height", "m", "Whole height.", limits::positive});
    }
    void prepare() {
        if (sides != std::floor(sides)) throw ModelError("prism: \"sides\" must be a whole number");
        detail::require_usable(info.name, {radius, height});
        const double step = 3.14159265358979323846 / static_cast<double>(sides);
        int count = 0;
        for (int m = static_cast<int>(sides); m > 1; ++count) {
            m = (m + 1) / 2;
            cosine[count] = static_cast<float>(std::cos(step * m));
            sine[count] = static_cast<float>(std::sin(step * m));
        }
        folds = static_cast<float>(count);
        apothem = static_cast<float>(static_cast<double>(radius) * std::cos(step));
        half_edge = static_cast<float>(static_cast<double>(radius) * std::sin(step));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        T x = p.x, y = abs(p.y);
        for (int i = 0; i < static_cast<int>(folds); ++i) {
            const T beyond = max(y * cosine[i] - x * sine[i], T(0.f)) * 2.f;
            x = x + beyond * sine[i];
            y = y - beyond * cosine[i];
        }
        // Inside, no point of the sector is beyond the edge's end.
        const T zero(0.f), side = x - apothem;
        const T polygon = length(max(side, zero), max(y - half_edge, zero)) + min(side, zero);
        return detail::corner_distance(polygon, abs(p.z) - height * 0.5f);
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
