// Requirements on a vertex: a point where a path is scattered, so that it receives light from the lights and gathers
// photons. Surfaces and points in media are the two kinds.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>
#include <optional>

#include "caustics/photon.hpp"
#include "integrator/light_proposal.hpp"
#include "integrator/path_context.hpp"
#include "integrator/path_state.hpp"
#include "integrator/photon_density.hpp"
#include "world/ray.hpp"

namespace phasetree::tracer {

/// How a vertex scatters light from one direction into the path.
struct Scattering {
    glm::vec3 f;               ///< the BSDF times the cosine, or the phase function
    float pdf;                 ///< with which the path itself would continue in that direction
    PhotonDensity by_photons;  ///< with which photons find that direction
    Ray ray;                   ///< leaves the vertex in that direction
};

/// How a vertex scatters the light of one photon into the path.
struct PhotonScattering {
    glm::vec3 power;   ///< the photon's, attenuated up to the vertex; in a medium, also divided by the coverage F
    glm::vec3 f;       ///< the BSDF or the phase function for the photon's direction
    float pdf;         ///< with which the path itself would continue in that direction
    float by_photons;  ///< the density with which photons find that direction
};

/// * proposal(): the distribution of the directions of shadow rays.
/// * scattering(w): how light from the direction w is scattered; nullopt if it is not.
/// * interfaces_before(): PathChain::interfaces_before of a chain that starts at the vertex.
/// * position(): the point around which photons are gathered.
/// * for_each_photon(context, path, use): calls use(photon, scattering) for each photon that is gathered. Requires
/// photons.
template <class V>
concept PathVertex = requires(const V& vertex, const glm::vec3& w, const PathContext& context, const PathState& path,
                              void (*use)(const Photon&, const PhotonScattering&)) {
    { vertex.proposal() } -> std::same_as<const LightProposal&>;
    { vertex.scattering(w) } -> std::same_as<std::optional<Scattering>>;
    { vertex.interfaces_before() } -> std::same_as<int>;
    { vertex.position() } -> std::convertible_to<glm::vec3>;
    vertex.for_each_photon(context, path, use);
};

}  // namespace phasetree::tracer
