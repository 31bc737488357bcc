#pragma once

#include <glm/trigonometric.hpp>

#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The x axis becomes an arc of curvature k around (0, ·, 1/k); distances from the axis are preserved. With polar
/// coordinates (r, θ) around that centre, in units of 1/k, the inverse warp ω⁻¹ (warped.hpp) is x = θ/k, z = (1 − r)/k.
/// Its Jacobian J is a rotation times diag(1/r, 1, 1), and λ = 1/r on the side facing the centre.
///
/// The box around ω(A) extends nearer to the centre than ω(A) itself, up to the centre, where 1/r is unbounded. Within
/// r < r₀, three quarters of the smallest r of ω(A), the map continues as x = (θ/k)(r/r₀), z = (1 − r₀)/k. There J has
/// the entries θ/r₀ along r and 1/r₀ across, so λ = ‖J‖ = √(1 + θ²)/r₀. The bend is limited to a quarter of a turn on
/// either side. The box then stays on one side of the centre, where θ is continuous, and |θ| in it stays below that of
/// A's ends.
struct Bend {
    static constexpr NodeInfo info{"bend", "6",
                                   "φ(θ/k, y, (1 − r)/k) / λ,  (r, θ) polar: r sin θ = k x, r cos θ = 1 − k z",
                                   "Bends the x axis into an arc towards +z."};
    static constexpr bool local = true;

    struct Map {
        float k, side;        ///< curvature, and +1 or −1 for the direction of the bend
        float radius;         ///< 1/k
        float near, highest;  ///< r₀, and the largest z that the map returns, (1 − r₀)/k
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            if (k == 0.f) return p;
            const T z = p.z * side, across = p.x * k, towards = max(1.f - z * k, T(0.f));
            const T r = sqrt(across * across + towards * towards);
            const T x = angle_of(towards, across) * min(r * (1.f / near), T(1.f)) * radius;
            // (1 − r)/k as (1 − r²)/(k (1 + r)), without cancellation
            const T height = (z * (2.f - z * k) - p.x * across) / (r + 1.f);
            return {x, p.y, min(height, T(highest)) * side};
        }
    };

    float rate = 0;
    Map inverse{0, 1, 0, 1, 0};  ///< derived
    float angle = 0;             ///< largest |θ| of the object, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Bend::rate,
          Parameter{"rate", "degrees/m", "Angle per unit of length along x; negative to bend towards −z."});
    }
    void fit(const Bounds& child) {
        inverse = {0, 1, 0, 1, 0};
        angle = 0;
        const float k = glm::radians(std::abs(rate)), side = rate < 0 ? -1.f : 1.f;
        if (!(k > 1e-12f)) return;
        angle = k * std::max(std::abs(child.low.x), std::abs(child.high.x));
        if (angle > 1.570797f) throw ModelError("bend: more than a quarter of a turn from the origin to an end");
        const float top = side > 0 ? child.high.z : -child.low.z;
        if (!(k * top < 0.98f)) throw ModelError("bend: the object reaches the centre of the arc");
        const float near = 0.75f * (1 - k * top);
        inverse = {k, side, 1 / k, near, (1 - near) / k};
        if (!std::isfinite(inverse.near)) throw ModelError("bend: the object is too large");
    }
    Map map() const { return inverse; }
    float value_scale() const {
        if (inverse.k == 0) return 1;
        return std::min(1.f, inverse.near / std::sqrt(1 + angle * angle)) * (1 - 2e-6f);
    }
    Bounds image(const Bounds& b) const {
        if (inverse.k == 0 || b.empty()) return b;
        const double k = inverse.k;
        const double level = std::clamp(0.f, b.low.x, b.high.x);  // where the arc is nearest to horizontal
        Bounds result;
        for (const double x : {static_cast<double>(b.low.x), level, static_cast<double>(b.high.x)}) {
            for (const float end : {b.low.z, b.high.z}) {
                const double z = static_cast<double>(end) * inverse.side, s = std::sin(0.5 * k * x);
                const glm::vec3 p(std::sin(k * x) * (1 / k - z), 0,
                                  (z * std::cos(k * x) + 2 * s * s / k) * inverse.side);
                result = unite(result, {{p.x, b.low.y, p.z}, {p.x, b.high.y, p.z}});
            }
        }
        return result.inflated(2e-6f * result.diagonal());
    }
};

}  // namespace phasetree
