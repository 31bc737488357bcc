// Requirements on a phase function: how light that is scattered at a point of a medium is distributed over directions.
// media/phase_function.hpp lists all kinds.
#pragma once

#include <concepts>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// * evaluate(cosine): the density per steradian; `cosine` is that between the directions of travel before and after.
///   It integrates to 1 over all directions, and is exactly the pdf of sample(), so sampling needs no weight.
/// * sample(u): the direction of travel after scattering, in a frame whose z is the direction before; u is in [0, 1)².
/// * mean_cosine(): the mean of the cosine, in (−1, 1).
template <class P>
concept PhaseFunctionKind = std::copyable<P> && requires(const P& phase, float cosine, const glm::vec2& u) {
    { phase.evaluate(cosine) } -> std::same_as<float>;
    { phase.sample(u) } -> std::same_as<glm::vec3>;
    { phase.mean_cosine() } -> std::same_as<float>;
};

}  // namespace phasetree::tracer
