// A vertex of a path in a scattering medium: how it receives light, and how the path leaves it.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>

#include "caustics/photon_map.hpp"
#include "caustics/photon_placement.hpp"
#include "integrator/light_proposal.hpp"
#include "integrator/path_context.hpp"
#include "integrator/path_state.hpp"
#include "integrator/photon_density.hpp"
#include "integrator/vertex.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class MediumVertex {
  public:
    /// The path is scattered on its current segment, at this distance from the origin.
    MediumVertex(const PathContext& context, const PathState& path, float distance);

    const LightProposal& proposal() const { return proposal_; }
    /// Always has a value.
    std::optional<Scattering> scattering(const glm::vec3& direction) const;
    int interfaces_before() const { return 0; }
    const glm::vec3& position() const { return point_.position; }

    template <class Use>
    void for_each_photon(const PathContext& context, const PathState& path, const Use& use) const {
        if (!placement_) return;
        context.photons.map->near_in_medium(position(), point_.phase, [&](const Photon& photon, float depth) {
            if (const auto scattering = scattering_of(photon, depth, context, path.wavelengths))
                use(photon, *scattering);
        });
    }

    /// The direction sampled from the phase function by u in [0, 1)².
    glm::vec3 sample_direction(const glm::vec2& u) const;
    Ray leaving(const glm::vec3& direction) const { return point_.leaving(direction); }
    /// The chain of a path that leaves the point in this direction.
    PathChain chain_from(const glm::vec3& direction) const;

  private:
    float phase_function(const glm::vec3& direction) const {
        return point_.phase_function.get().evaluate(glm::dot(arriving_, direction));
    }
    /// `depth` is how far behind the boundary, along the photon's line, the point of the line closest to the vertex is;
    /// it is negative in front of the boundary.
    std::optional<PhotonScattering> scattering_of(const Photon& photon, float depth, const PathContext& context,
                                                  const PathWavelengths& wavelengths) const;

    const Medium& medium_;
    MediumPoint point_;
    glm::vec3 arriving_;  ///< direction of the path's segment that ends here
    LightProposal proposal_;
    std::optional<PhotonPlacement> placement_;  ///< nullopt if the vertex gathers no photons
    /// N π r² n², which is multiplied by the line density and F to give the density of photons (photon_density.hpp); 0
    /// if the vertex gathers no photons.
    float per_line_density_without_cosine_;
};

static_assert(PathVertex<MediumVertex>);

}  // namespace phasetree::tracer
