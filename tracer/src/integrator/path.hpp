// Unidirectional path tracing from phase to phase (Kajiya: The Rendering Equation, SIGGRAPH 1986), with next-event
// estimation, multiple importance sampling by the power heuristic (Veach & Guibas, SIGGRAPH 1995) and Russian roulette.
#pragma once

#include "camera/thin_lens.hpp"
#include "integrator/world.hpp"
#include "sampling/sobol.hpp"

namespace phasetree::tracer {

struct PathCounters {
    TraceCounters trace;
    std::uint64_t paths = 0;
    std::uint64_t interactions = 0;
};

// An unbiased estimate of the radiance that arrives along a ray that starts in the phase.
//
// Light through clear interfaces: a shadow ray ends at the first interface of different indices. What arrives bent is
// found by the paths themselves: after a smooth interface no light is sampled, so the light they meet counts whole;
// after any other, both techniques could have met it and are weighted. Nothing is counted twice and nothing is lost;
// the price is noise where a small bright light is seen through glass, so light such scenes with large ones.
glm::vec3 trace_path(const World& world, const Scene& scene, CameraRay ray, Phase phase, Sampler& sampler,
                     PathCounters& counters);

}  // namespace phasetree::tracer
