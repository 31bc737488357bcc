// The mean of a function over the microfacet normals that a direction sees, by a quadrature that is the same every
// time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sampling/ggx.hpp"

namespace phasetree::tracer {

/// `function(wo, m)` gives a glm::vec3, and `wo` is at that angle to the surface's normal. What it gives must be the
/// same on both sides of the plane of wo and the normal.
template <class Function>
glm::vec3 mean_over_visible_normals(const Ggx& ggx, float cos_theta, const Function& function) {
    // A lattice of two successive Fibonacci numbers. Its first coordinate is the azimuth of the normal, of which one
    // side of the plane is enough: the other mirrors it, so that this is as good as twice as many points all around.
    constexpr std::uint32_t samples = 2584, before = 1597;
    const glm::vec3 wo{std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta)), 0.0f, cos_theta};
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 u{0.5f * (static_cast<float>(i) + 0.5f) / samples,
                          static_cast<float>(i * before % samples) / samples};
        const glm::vec3 m = ggx.sample_visible_normal(wo, u);
        if (glm::dot(wo, m) > 0.0f) sum += glm::dvec3(function(wo, m));
    }
    return glm::vec3(sum / static_cast<double>(samples));
}

}  // namespace phasetree::tracer
