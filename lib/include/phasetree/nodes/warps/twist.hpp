#pragma once

#include <glm/trigonometric.hpp>

#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// Rotates each slice z = const by k·z; ω⁻¹ rotates it back. J is a rotation times the shear (ρ dθ, dz) ↦ (ρ dθ − kρ
/// dz, dz). Its largest singular value at distance ρ from the axis is (|k|ρ + √(k²ρ² + 4)) / 2. This is unbounded in
/// space, so λ is taken over the object's bounds; see warped.hpp.
struct Twist {
    static constexpr NodeInfo info{"twist", "6",
                                   "φ(R(−k z) p) / λ,  λ = (kρ + √(k²ρ² + 4))/2,  ρ the largest within the bounds",
                                   "Twists about the z axis."};
    static constexpr bool local = true;
    float rate = 0;
    float reach = 0;  ///< largest distance from the axis within the bounds, derived

    struct Map {
        float radians;
        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            const auto [s, c] = sine_cosine(p.z * radians);
            return {p.x * c + p.y * s, p.y * c - p.x * s, p.z};
        }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Twist::rate, Parameter{"rate", "degrees/m", "Angle per unit of height."});
    }
    void fit(const Bounds& child) {
        reach = 0;
        for (int i = 0; i < 4; ++i) reach = std::max(reach, glm::length(glm::vec2(child.corner(i))));
        const float angle = std::abs(glm::radians(rate)) * std::max(std::abs(child.low.z), std::abs(child.high.z));
        if (angle > 5000.f) throw ModelError("twist: more than 800 turns from the origin to an end of the object");
    }
    Map map() const { return {glm::radians(rate)}; }
    float value_scale() const {
        // The box around the circle extends √2 further at its corners.
        const float k = std::abs(glm::radians(rate)) * reach * 1.41422f;
        return 2.f / (k + std::sqrt(k * k + 4.f)) * (1.f - 1e-6f);
    }
    Bounds image(const Bounds& b) const {
        if (b.empty()) return b;
        return {{-reach, -reach, b.low.z}, {reach, reach, b.high.z}};
    }
};

}  // namespace phasetree
