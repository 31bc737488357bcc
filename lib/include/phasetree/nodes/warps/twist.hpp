#pragma once

#include <glm/trigonometric.hpp>

#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The warp ω rotates each slice z = const by k·z. Its inverse ω⁻¹, which maps points to where the child is evaluated,
/// rotates it back. The Jacobian J of ω⁻¹ is a rotation times the shear (ρ dθ, dz) ↦ (ρ dθ − kρ dz, dz). At distance ρ
/// from the axis, its largest singular value is (|k|ρ + √(k²ρ² + 4)) / 2. This is unbounded in space, so λ, by which
/// distances are divided, is the largest value within the object's bounds (warped.hpp).
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
        // The corners of image(), the box around the circle of radius `reach`, are √2 times as far from the axis.
        const float k = std::abs(glm::radians(rate)) * reach * 1.41422f;
        return 2.f / (k + std::sqrt(k * k + 4.f)) * (1.f - 1e-6f);
    }
    Bounds image(const Bounds& b) const {
        if (b.empty()) return b;
        return {{-reach, -reach, b.low.z}, {reach, reach, b.high.z}};
    }
};

}  // namespace phasetree
