// The mean of a function over the microfacet normals visible from a direction, by a deterministic quadrature.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sampling/ggx.hpp"

namespace phasetree::tracer {

/// A Fibonacci lattice: `before` and `samples` are two successive Fibonacci numbers.
struct FibonacciLattice {
    std::uint32_t samples, before;
};

/// `function(wo, m)` returns a glm::vec3. The azimuths of the normals cover `turns` of a full turn.
template <class Function>
glm::vec3 mean_over_visible_normals(const Ggx& ggx, const glm::vec3& wo, const Function& function,
                                    const FibonacciLattice& lattice = {4181, 2584}, float turns = 1.0f) {
    const auto [samples, before] = lattice;
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        // The lattice's first coordinate is the azimuth of the normal.
        const auto number = static_cast<float>(samples);
        const glm::vec2 u{turns * (static_cast<float>(i) + 0.5f) / number,
                          static_cast<float>(i * before % samples) / number};
        const glm::vec3 m = ggx.sample_visible_normal(wo, u);
        if (glm::dot(wo, m) > 0.0f) sum += glm::dvec3(function(wo, m));
    }
    return glm::vec3(sum / static_cast<double>(samples));
}

/// `function(wo, m)` returns a glm::vec3. The surface has no grain, `wo` is at that angle to its normal, and the result
/// must be symmetric about the plane of wo and the normal.
template <class Function>
glm::vec3 mean_over_visible_normals(const Ggx& ggx, float cos_theta, const Function& function) {
    // By symmetry, normals on one side of the plane are enough, which is equivalent to twice as many points all around.
    const glm::vec3 wo{std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta)), 0.0f, cos_theta};
    return mean_over_visible_normals(ggx, wo, function, {2584, 1597}, 0.5f);
}

}  // namespace phasetree::tracer
