#pragma once

#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The warp ω (warped.hpp) scales the slice z = const by s = 1 + cz, so ω⁻¹(p) = (x/s, y/s, z). With ρ the distance
/// from the axis *after* ω⁻¹, the Jacobian of ω⁻¹ is 1/s across, and ((1/s, −ρc/s), (0, 1)) in the plane of the axis.
/// The norm of this matrix increases with each entry, and is √(n + √(n² − 4a²)) / √2 with n = a² + b² + 1, a = 1/s, b =
/// ρ|c|/s. λ is its value at the smallest s and the largest ρ.
///
/// The box around ω(A) contains points that ω⁻¹ maps far beyond A. x/s and y/s are therefore clamped to A's bounds plus
/// a quarter of A's size. This only shortens J, and bounds ρ.
struct Taper {
    static constexpr NodeInfo info{"taper", "6", "φ(x/s, y/s, z) / λ,  s = 1 + c z",
                                   "Narrows or widens along the z axis."};
    static constexpr bool local = true;

    struct Map {
        float rate;
        float low_x, low_y, high_x, high_y;
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            const T s = p.z * rate + 1.f;
            return {clamp(p.x / s, T(low_x), T(high_x)), clamp(p.y / s, T(low_y), T(high_y)), p.z};
        }
    };

    float rate = 0;
    Map inverse{};        ///< derived
    float narrowest = 1;  ///< smallest s within the bounds, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Taper::rate, Parameter{"rate", "1/m", "Change of size per unit of height; the size at z = 0 is unchanged."});
    }
    void fit(const Bounds& child) {
        narrowest = std::min(scale_at(child.low.z), scale_at(child.high.z));
        if (!(narrowest >= 0.01f))
            throw ModelError("taper: an end of the object is narrowed to less than a hundredth, or past the apex");
        const glm::vec3 margin = child.extent() * 0.25f;
        const glm::vec3 low = child.low - margin, high = child.high + margin;
        inverse = {rate, low.x, low.y, high.x, high.y};
        if (!std::isfinite(scale_at(child.low.z) * scale_at(child.high.z)))
            throw ModelError("taper: an end of the object is widened without bound");
    }
    Map map() const { return inverse; }
    float value_scale() const {
        if (rate == 0) return 1;
        const double rho =
            portable::hypot(std::max(-inverse.low_x, inverse.high_x), std::max(-inverse.low_y, inverse.high_y));
        const double a = 1.0 / narrowest, b = rho * std::abs(rate) * a, n = a * a + b * b + 1;
        return static_cast<float>((1 - 1e-6) / std::sqrt(0.5 * (n + std::sqrt(std::max(n * n - 4 * a * a, 0.0)))));
    }
    Bounds image(const Bounds& b) const {
        if (b.empty()) return b;
        Bounds result;
        for (int i = 0; i < 8; ++i) {
            glm::vec3 p = b.corner(i);
            p.x *= scale_at(p.z);
            p.y *= scale_at(p.z);
            result = unite(result, {p, p});
        }
        return result.inflated(1e-6f * result.diagonal());
    }

  private:
    float scale_at(float z) const { return 1 + rate * z; }
};

}  // namespace phasetree
