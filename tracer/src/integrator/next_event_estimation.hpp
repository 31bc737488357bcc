// Next-event estimation: the light that arrives at a vertex by a shadow ray and is scattered into the path.
#pragma once

#include "integrator/path_context.hpp"
#include "integrator/path_radiance.hpp"
#include "integrator/path_state.hpp"
#include "integrator/vertex.hpp"
#include "lights/lights.hpp"

namespace phasetree::tracer {

/// Traces a shadow ray to a sampled light, and adds what it finds. `interfaces_before` is that of the vertex.
void add_light_of_shadow_ray(const PathContext& context, const PathState& path, const LightSample& light,
                             const Scattering& scattering, int interfaces_before, PathRadiance& radiance);

/// Samples a light at the vertex, and adds what a shadow ray to it finds. `path` is that which arrives at the vertex.
template <PathVertex Vertex>
void add_direct_light(const PathContext& context, const PathState& path, const Vertex& vertex, PathRadiance& radiance) {
    const auto light = vertex.proposal().sample(context.scene.lights, context.sampler.next2(), path.wavelengths.now());
    if (!light) return;
    if (const auto scattering = vertex.scattering(light->wi))
        add_light_of_shadow_ray(context, path, *light, *scattering, vertex.interfaces_before(), radiance);
}

}  // namespace phasetree::tracer
