// A vertex of a path on a surface: how it receives light, and how the path leaves it.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "caustics/photon_map.hpp"
#include "integrator/guided.hpp"
#include "integrator/light_proposal.hpp"
#include "integrator/path_context.hpp"
#include "integrator/path_guiding.hpp"
#include "integrator/path_state.hpp"
#include "integrator/photon_density.hpp"
#include "integrator/vertex.hpp"
#include "world/chain.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

class SurfaceVertex {
  public:
    /// The path has met the surface, which has this BSDF. Keeps references to the scene, the surface and the BSDF,
    /// which must outlive it.
    SurfaceVertex(const PathContext& context, const PathState& path, const PathGuiding& guiding, const Surface& surface,
                  const Bsdf& bsdf);
    SurfaceVertex(const SurfaceVertex&) = delete;  // bsdf_ refers to frame_
    SurfaceVertex& operator=(const SurfaceVertex&) = delete;

    const Surface& surface() const { return surface_; }
    const Frame& frame() const { return frame_; }
    const GuidedBsdf& bsdf() const { return bsdf_; }

    /// Whether a shadow ray or a photon can bring light that is scattered here: not if all lobes are delta.
    bool receives_light() const { return !bsdf_.bsdf().is_delta(); }
    /// Requires receives_light(). Photons that continue from this surface to an earlier vertex use the pdf of this
    /// proposal in their MIS weights, too.
    const LightProposal& proposal() const { return proposal_; }
    std::optional<Scattering> scattering(const glm::vec3& direction) const;
    int interfaces_before() const { return interfaces_before_; }
    const glm::vec3& position() const { return surface_.near_side.origin; }

    template <class Use>
    void for_each_photon(const PathContext& context, const PathState&, const Use& use) const {
        if (is_passed_by_photons()) return;
        const auto gather = [&](const Photon& photon) {
            if (const auto scattering = scattering_of(photon)) use(photon, *scattering);
        };
        if (has_photons_of_interfaces(surface_))
            context.photons.map->near_at_interface(position(), surface_.geometric_normal, gather);
        else
            context.photons.map->near(position(), surface_.geometric_normal, gather);
    }

    /// The chain of a path that leaves the surface by a lobe that is not delta. `direction` is that of the sample in
    /// world space.
    PathChain chain_from(const GuidedBsdf::Sample& next, const glm::vec3& direction) const;

  private:
    /// Whether photons that continue from the surface are gathered at an earlier vertex of the path, and not here.
    bool is_passed_by_photons() const { return per_line_density_before_.has_value(); }
    /// PhotonDensity::per_line_density (the factor of the line density) of a direction in the frame.
    float per_line_density(const glm::vec3& wi) const;
    std::optional<PhotonScattering> scattering_of(const Photon& photon) const;

    const Scene& scene_;
    Photons photons_;
    const Surface& surface_;
    Frame frame_;
    GuidedBsdf bsdf_;
    /// If photons are gathered at an earlier vertex: PhotonDensity::per_line_density there, divided by the pdf with
    /// which the path left it.
    std::optional<float> per_line_density_before_;
    int interfaces_before_ = 0;
    LightProposal proposal_;
};

static_assert(PathVertex<SurfaceVertex>);

}  // namespace phasetree::tracer
