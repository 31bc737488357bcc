// The density with which photons find the directions at a point that gathers them (path.hpp), without its last factor,
// the line density, which is known only at the light's end of a chain.
#pragma once

#include <optional>

#include "caustics/photon_placement.hpp"
#include "integrator/guided.hpp"
#include "integrator/path_context.hpp"
#include "scene/scene.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// The density with which photons find a direction is `per_line_density` times the line density at the light's end of
/// the chain. `per_line_density` is N π r² n² cos θ on a surface and N π r² n² F in a medium (path.hpp). For each rough
/// interface on the way, it is multiplied by that interface's factor R, rough_factor(), and divided by the pdf of the
/// direction in which the path left the previous vertex (rough_chain.hpp).
struct PhotonDensity {
    float per_line_density = 0;
    /// Set while F is still missing: in a medium that gathers photons, until the chain's first boundary is known.
    std::optional<PhotonPlacement> placement{};

    /// Multiplies by F, given the distance of the boundary where the chain leaves the medium. Later calls have no
    /// effect.
    void reach_boundary(float distance) {
        if (placement) per_line_density *= placement->coverage(distance);
        placement.reset();
    }
};

/// The cosine between `wi`, in the frame, and the geometric normal. It converts density across the line into density
/// per area of the surface. 0 if the shading normal and the geometric normal disagree about the side.
float photon_cosine(const Surface& surface, const Frame& frame, const glm::vec3& wi);

/// N π r² n², the factor common to surfaces and media. In a dispersive phase, n is that of the d line: all techniques
/// use the same factor, so their weights still sum to 1. Requires photons.
float per_line_density_without_cosine(const Photons& photons, const Scene& scene, Phase phase);

/// PhotonDensity::per_line_density of a direction at a surface that gathers photons; 0 if photons from that direction
/// are not used.
float per_line_density_at(const Photons& photons, const Scene& scene, const Surface& surface, const GuidedBsdf& bsdf,
                          const glm::vec3& wi);

/// As above, for a direction that continues from a rough interface, if photons are gathered at an earlier vertex.
/// `before` is the per_line_density of the direction in which the path left the earlier vertex, divided by the pdf of
/// that direction.
float per_line_density_beyond(float before, const Scene& scene, const Surface& surface, const GuidedBsdf& bsdf,
                              const glm::vec3& wi);

}  // namespace phasetree::tracer
