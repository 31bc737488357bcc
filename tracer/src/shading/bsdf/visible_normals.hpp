// The mean of a function over the microfacet normals that a direction sees, by a quadrature that is the same every
// time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sampling/ggx.hpp"
#include "sampling/sobol.hpp"

namespace phasetree::tracer {

/// `function(wo, m)` gives a glm::vec3, and `wo` is at that angle to the surface's normal.
template <class Function>
glm::vec3 mean_over_visible_normals(const Ggx& ggx, float cos_theta, const Function& function) {
    constexpr std::uint32_t samples = 2048;
    const glm::vec3 wo{std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta)), 0.0f, cos_theta};
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 u{static_cast<float>(sobol_first(i) >> 8) * 0x1p-24f,
                          static_cast<float>(sobol_second(i) >> 8) * 0x1p-24f};
        const glm::vec3 m = ggx.sample_visible_normal(wo, u);
        if (glm::dot(wo, m) > 0.0f) sum += glm::dvec3(function(wo, m));
    }
    return glm::vec3(sum / static_cast<double>(samples));
}

}  // namespace phasetree::tracer
