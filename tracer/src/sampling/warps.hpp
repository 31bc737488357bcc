// Maps from the unit square to directions and disks, each with its pdf.
//
// Pdfs are with respect to solid angle (directions) or area (disk). Directions are in a local frame whose z is the axis
// of the distribution.
//
// References: Shirley & Chiu, A Low Distortion Map Between Disk and Square, JGT 2(3), 1997; Pharr, Jakob & Humphreys,
// Physically Based Rendering, 4th ed., Appendix A.5. ggx.hpp samples microfacet normals.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace phasetree::tracer {

inline constexpr float pi = std::numbers::pi_v<float>;

/// Concentric map to the unit disk: squares around the centre become circles, so neighbours stay neighbours.
inline glm::vec2 square_to_uniform_disk(const glm::vec2& u) {
    const float x = 2.0f * u.x - 1.0f;
    const float y = 2.0f * u.y - 1.0f;
    if (x == 0.0f && y == 0.0f) return {0.0f, 0.0f};
    float radius = 0.0f;
    float angle = 0.0f;
    if (std::abs(x) > std::abs(y)) {
        radius = x;
        angle = (pi / 4.0f) * (y / x);
    } else {
        radius = y;
        angle = (pi / 2.0f) - (pi / 4.0f) * (x / y);
    }
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

inline float uniform_disk_pdf() {
    return 1.0f / pi;
}

inline glm::vec3 square_to_cosine_hemisphere(const glm::vec2& u) {
    const glm::vec2 d = square_to_uniform_disk(u);
    return {d.x, d.y, std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y))};
}

inline float cosine_hemisphere_pdf(float cos_theta) {
    return std::max(0.0f, cos_theta) / pi;
}

/// Uniform in the cone around +z with half-angle θ; `height` = 1 − cos θ, in [0, 2]. It is given instead of cos θ
/// because 1 − cos θ of a small light (the sun: 1.1e-5) would cancel in a float.
inline glm::vec3 square_to_uniform_cone(const glm::vec2& u, float height) {
    const float below_pole = u.x * height;
    const float sin_theta = std::sqrt(std::max(0.0f, below_pole * (2.0f - below_pole)));
    const float phi = 2.0f * pi * u.y;
    return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1.0f - below_pole};
}

inline float uniform_cone_pdf(float height) {
    return 1.0f / (2.0f * pi * height);
}

inline glm::vec3 square_to_uniform_sphere(const glm::vec2& u) {
    return square_to_uniform_cone(u, 2.0f);
}

inline float uniform_sphere_pdf() {
    return 1.0f / (4.0f * pi);
}

}  // namespace phasetree::tracer
