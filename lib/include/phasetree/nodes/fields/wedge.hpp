#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A right triangle in xz, extruded along y. With half legs a and b, its corners are (−a, −b), (a, −b), (−a, b); the
/// hypotenuse x/a + z/b = 0 passes through the origin. The triangle's distance is that to its nearest side, and
/// negative where all three half-planes contain the point.
struct Wedge {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"wedge", "",
                                   "q = (± distance to the triangle's sides, |py| − sy/2);  "
                                   "|max(q, 0)| + min(max(qx, qy), 0)",
                                   "Half of a box about the origin, below the plane x/sx + z/sz = 0; exact."};
    glm::vec3 size{1};
    float slope_x = 0;  ///< the slanted face's unit normal, derived
    float slope_z = 0;
    float half_length = 0;  ///< of the hypotenuse, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Wedge::size, Parameter{"size", "m", "Edge lengths along x, y and z.", limits::positive});
    }
    void prepare() {
        detail::require_usable(info.name, {size.x, size.y, size.z});
        const double x = size.x, z = size.z, s = std::sqrt(x * x + z * z);
        slope_x = static_cast<float>(z / s);
        slope_z = static_cast<float>(x / s);
        half_length = static_cast<float>(s / 2);
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T zero(0.f);
        const float a = size.x * 0.5f, b = size.z * 0.5f;
        const T above = p.x * slope_x + p.z * slope_z;
        const T along = max(abs(p.z * slope_x - p.x * slope_z) - half_length, zero);
        const T left = -p.x - a, below = -p.z - b;
        const T past_left = max(abs(p.z) - b, zero), past_below = max(abs(p.x) - a, zero);
        const T nearest = min(above * above + along * along,
                              min(left * left + past_left * past_left, below * below + past_below * past_below));
        // Outside, the side that p is in front of is the nearest one. Near a corner, another side is equally near up to
        // rounding, and the gradient is that of the side chosen.
        const auto before = [&](const T& height, const T& past, const T& otherwise) {
            return select(less(zero, height), select(less(zero, past), otherwise, height * height), otherwise);
        };
        const T d = sqrt(before(above, along, before(left, past_left, before(below, past_below, nearest))));
        const T triangle = select(less(max(above, max(left, below)), zero), -d, d);
        return corner(triangle, abs(p.y) - size.y * 0.5f);
    }
    double support(const glm::dvec3& d, float level) const {
        const glm::dvec3 h = glm::dvec3(size) * 0.5;
        return detail::hull_support(d, {{-h.x, 0, -h.z}, {h.x, 0, -h.z}, {-h.x, 0, h.z}}) + std::abs(d.y) * h.y +
               glm::length(d) * static_cast<double>(level);
    }
    /// For a negative level, {f ≤ level} is a smaller wedge, which lies in the box shrunk by −level.
    Bounds bounds(BoundsQuery&, float level) const { return Bounds::centred(size * 0.5f + level); }
};

}  // namespace phasetree
