#pragma once

#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// Rounded corners come from inflating a smaller rectangle.
struct Rectangle {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"rectangle", "", "q = |pxy| − s/2 + r;  |max(q, 0)| + min(max(qx, qy), 0) − r",
                                   "A rectangle about the origin, for extruding and revolving; the same at every z, "
                                   "exact."};
    float width = 1;
    float height = 1;
    float corner_radius = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&Rectangle::width, Parameter{"width", "m", "Whole length along x.", limits::positive});
        v(&Rectangle::height, Parameter{"height", "m", "Whole length along y.", limits::positive});
        v(&Rectangle::corner_radius, Parameter{"radius", "m", "Radius of the corners, at most half the shorter side.",
                                               limits::non_negative, true});
    }
    void prepare() const {
        if (corner_radius > std::min(width, height) * 0.5f)
            throw ModelError("rectangle: the radius is more than half of the shorter side");
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return corner(abs(p.x) - (width * 0.5f - corner_radius), abs(p.y) - (height * 0.5f - corner_radius)) -
               corner_radius;
    }
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred({width * 0.5f + level, height * 0.5f + level, Bounds::infinity});
    }
};

}  // namespace phasetree
