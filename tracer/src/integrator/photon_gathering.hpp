// Photon gathering: the light of the photons near a vertex that is scattered into the path.
#pragma once

#include "integrator/path_context.hpp"
#include "integrator/path_radiance.hpp"
#include "integrator/path_state.hpp"
#include "integrator/vertex.hpp"

namespace phasetree::tracer {

/// Adds the contribution of one photon at a vertex, given the vertex's position and its distribution of shadow rays.
void add_light_of_photon(const PathContext& context, const PathState& path, const Photon& photon,
                         const PhotonScattering& scattering, const glm::vec3& position, const LightProposal& proposal,
                         PathRadiance& radiance);

/// Adds the photons that are gathered at a vertex. `path` is that which arrives there. Does nothing without photons, or
/// if some techniques are disabled.
template <PathVertex Vertex>
void gather_photons(const PathContext& context, const PathState& path, const Vertex& vertex, PathRadiance& radiance) {
    if (!context.photons || context.scene.settings.techniques != Techniques::all) return;
    vertex.for_each_photon(context, path, [&](const Photon& photon, const PhotonScattering& scattering) {
        add_light_of_photon(context, path, photon, scattering, vertex.position(), vertex.proposal(), radiance);
    });
}

}  // namespace phasetree::tracer
