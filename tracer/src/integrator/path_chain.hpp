// What a path remembers of the last vertex where lights were sampled, and of the chain of smooth interfaces since. It
// determines the MIS weight of emission found at the end of the chain (path.hpp).
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "integrator/light_proposal.hpp"
#include "integrator/path_context.hpp"
#include "integrator/photon_density.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

struct PathChain {
    /// The pdf with which the path chose the chain's first direction: by the BSDF, a guide, or the phase function.
    /// nullopt if lights were not sampled there.
    std::optional<float> pdf;
    LightProposal proposal{};  ///< how lights were sampled there
    glm::vec3 direction{0};    ///< the chain's first direction
    PhotonDensity by_photons{};
    /// The number of interfaces from the vertex that gathers photons to the start of this chain: 0 if the chain starts
    /// at that vertex; otherwise including the rough interface at which the chain starts. Meaningless if photons are
    /// gathered neither there nor at an earlier vertex.
    int interfaces_before = 0;
    int length = 0;           ///< number of smooth clear interfaces and mirrors
    bool has_mirror = false;  ///< a mirror, or a pane that reflects; if so, shadow rays do not follow it

    /// The number of interfaces between the point that gathers photons and the lamp.
    int interfaces() const { return interfaces_before + length; }
    /// Whether photons that pass a rough interface at the chain's end are gathered at an earlier vertex of the path.
    /// Otherwise, they are gathered at the rough interface. Photons contribute only at the vertex that gathers them.
    bool photons_count_earlier() const {
        return pdf && by_photons.per_line_density > 0.0f && is_photon_chain(interfaces() + 1);
    }

    /// The MIS weight of light that is seen along the ray. Light at the end of a chain that shadow rays and photons do
    /// not follow is found by the path alone, whichever techniques are selected.
    float weight(const Scene& scene, const Photons& photons, const Ray& ray) const;
    /// As above, for the emission of a surface that the ray met.
    float weight(const Scene& scene, const Photons& photons, const Ray& ray, const Surface& emissive) const;
    /// As above, for the emission of the ray's medium, from its origin up to a distance.
    float weight_of_medium(const Scene& scene, const Photons& photons, const Ray& ray, float distance) const;

  private:
    /// Evaluates the line density only if photons bring the light.
    template <class LineDensity>
    float weight_with(const Scene& scene, LineDensity&& line_density_at_end) const;
    float weight(const Scene& scene, float density_of_photons) const;
};

}  // namespace phasetree::tracer
