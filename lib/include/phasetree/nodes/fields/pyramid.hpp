#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// Fold to x ≥ y ≥ 0 by the square's mirrors. The nearest boundary point is then in the same eighth, on the base or on
/// the face that rises from its edge x = a. In the plane of that face, let v be the coordinate along its line of
/// steepest ascent, of length s = √(a² + h²), w the one along the outward normal, and y the one along the edge. The
/// face is the triangle (−a, 0), (a, 0), (0, s) in (y, v). The distance combines w and the distance to the triangle
/// within the plane: 0 inside, else that to the slanted side or to the edge of the base. Inside the solid, the same
/// base and face are nearest, because the solid is convex.
struct Pyramid {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{
        "pyramid", "", "± min(distance to the base, distance to the nearest slanted face)",
        "A pyramid with a square base about the z axis, with the origin at half its height; exact."};
    float base = 1;
    float height = 1;
    float slant = 1;  ///< s, derived
    float rise = 1;   ///< h/s, derived
    float run = 1;    ///< a/s, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Pyramid::base, Parameter{"base", "m", "Edge of the square at z = −height/2.", limits::positive});
        v(&Pyramid::height, Parameter{"height", "m", "Height of the apex above the base.", limits::positive});
    }
    void prepare() {
        detail::require_usable(info.name, {base, height});
        const double a = base / 2.0, h = height, s = std::sqrt(a * a + h * h);
        slant = static_cast<float>(s);
        rise = static_cast<float>(h / s);
        run = static_cast<float>(a / s);
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T zero(0.f);
        const float a = base * 0.5f;
        const T px = abs(p.x), py = abs(p.y);
        const T x = max(px, py), y = min(px, py), z = p.z + height * 0.5f;
        const T base_x = max(x - a, zero), base_y = max(y - a, zero);
        const T to_base = base_x * base_x + base_y * base_y + z * z;
        const T from_edge = x - a;
        const T v = z * rise - from_edge * run;
        const T w = from_edge * rise + z * run;
        // The triangle's slanted side runs from (a, 0) to (0, s).
        const T sy = y - a;
        const T t = clamp((v * slant - sy * a) * (1.f / (a * a + slant * slant)), zero, T(1.f));
        const T dy = sy + t * a, dv = v - t * slant;
        const T to_side = dy * dy + dv * dv;
        const T to_edge = base_y * base_y + v * v;
        const T beside = select(less(sy * slant + v * a, zero), zero, to_side);
        const T in_plane = select(less(v, zero), min(to_side, to_edge), beside);
        const T d = sqrt(min(to_base, in_plane + w * w));
        return select(less(max(w, -z), zero), -d, d);
    }
    double support(const glm::dvec3& d, float level) const {
        const double a = 0.5 * static_cast<double>(base), up = d.z * 0.5 * static_cast<double>(height);
        return std::max(up, (std::abs(d.x) + std::abs(d.y)) * a - up) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        const float a = base * 0.5f;
        return Bounds::centred(glm::vec3{a, a, height * 0.5f} + level);
    }
};

}  // namespace phasetree
