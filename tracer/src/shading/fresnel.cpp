#include "shading/fresnel.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::tracer {

DielectricFresnel fresnel_dielectric(float cos_theta, float eta) {
    const float c = std::clamp(cos_theta, 0.0f, 1.0f);
    const float sin2_transmitted = (1.0f - c) * (1.0f + c) / (eta * eta);
    if (!(sin2_transmitted < 1.0f)) return {1.0f, 0.0f};
    const float transmitted = std::sqrt(1.0f - sin2_transmitted);
    // At c = 0 all light is reflected, whatever eta; for eta = 1 both would be 0/0.
    if (c == 0.0f) return {1.0f, transmitted};
    const float parallel = (eta * c - transmitted) / (eta * c + transmitted);
    const float perpendicular = (c - eta * transmitted) / (c + eta * transmitted);
    return {std::min(1.0f, 0.5f * (parallel * parallel + perpendicular * perpendicular)), transmitted};
}

// Uses doubles, in which the fourth powers of any float η and k are finite.
float fresnel_conductor(float cos_theta, float eta, float k) {
    const double c = std::clamp(cos_theta, 0.0f, 1.0f);
    // At c = 0 all light is reflected; for η = 1, k = 0 it would be 0/0.
    if (c == 0) return 1.0f;
    const double n = eta, c2 = c * c, s2 = (1 - c) * (1 + c);
    // (a + ib)² = (η + ik)² − sin²θ
    const double real = n * n - static_cast<double>(k) * k - s2;
    const double imaginary = 2 * n * k;
    const double a2_plus_b2 = std::sqrt(real * real + imaginary * imaginary);
    const double a = std::sqrt(std::max(0.0, 0.5 * (a2_plus_b2 + real)));
    const double perpendicular = (a2_plus_b2 + c2 - 2 * a * c) / (a2_plus_b2 + c2 + 2 * a * c);
    const double parallel_ratio_top = c2 * a2_plus_b2 + s2 * s2 - 2 * a * c * s2;
    const double parallel_ratio_bottom = c2 * a2_plus_b2 + s2 * s2 + 2 * a * c * s2;
    if (!(parallel_ratio_bottom > 0)) return 1.0f;
    return static_cast<float>(
        std::clamp(0.5 * perpendicular * (1 + parallel_ratio_top / parallel_ratio_bottom), 0.0, 1.0));
}

glm::vec3 fresnel_conductor(float cos_theta, const glm::vec3& eta, const glm::vec3& k) {
    return {fresnel_conductor(cos_theta, eta.x, k.x), fresnel_conductor(cos_theta, eta.y, k.y),
            fresnel_conductor(cos_theta, eta.z, k.z)};
}

float k_of_reflectance(float reflectance) {
    const float r = std::clamp(reflectance, 0.0f, 0.9999f);
    return 2.0f * std::sqrt(r / (1.0f - r));
}

glm::vec3 k_of_reflectance(const glm::vec3& r) {
    return {k_of_reflectance(r.x), k_of_reflectance(r.y), k_of_reflectance(r.z)};
}

}  // namespace phasetree::tracer
