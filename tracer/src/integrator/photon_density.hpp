// With which density photons find the directions at a place that they light, as path.hpp has it, but for what only the
// end of a chain at the light knows: the line density.
#pragma once

#include <cmath>
#include <optional>

#include "caustics/photon_map.hpp"
#include "caustics/photon_placement.hpp"
#include "caustics/rough_chain.hpp"
#include "integrator/guided.hpp"
#include "integrator/path.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

/// The density with which photons find a direction is `per_line_density` times the line density at the light's end of
/// the chain. That factor is N π r² n² cos θ on a surface and N π r² n² F in a medium (path.hpp), times R of each rough
/// interface on the way, over the densities with which the path has chosen the directions before (rough_chain.hpp).
struct PhotonDensity {
    float per_line_density = 0;
    /// It is set while F is still missing: in a medium that photons light, until the chain's first boundary is known.
    std::optional<PhotonPlacement> placement{};

    /// Multiplies by F: the boundary at which the chain leaves the medium is at this distance. Later boundaries change
    /// nothing.
    void reach_boundary(float distance) {
        if (placement) per_line_density *= placement->coverage(distance);
        placement.reset();
    }
};

/// The cosine by which photons from a local direction are spread over the surface: it is by the geometric normal.
inline float photon_cosine(const Surface& surface, const Frame& frame, const glm::vec3& wi) {
    if (surface.far_side) return std::abs(wi.z);
    if (surface.normal == surface.geometric_normal) return wi.z;
    return wi.z > 0.0f ? glm::dot(frame.to_world(wi), surface.geometric_normal) : 0.0f;
}

/// N π r² n². Where a phase disperses, n is that of the d line: all techniques weigh by the same, so their weights
/// still sum to 1. There must be photons.
inline float per_line_density_across(const Photons& photons, const Scene& scene, Phase phase) {
    const float ior = clear_at(scene, phase).ior;
    return photons.map->expected() * ior * ior;
}

/// PhotonDensity::per_line_density of a direction at a surface on which photons count; 0 if they do not count in it.
inline float per_line_density_at(const Photons& photons, const Scene& scene, const Surface& surface,
                                 const GuidedBsdf& bsdf, const glm::vec3& wi) {
    // Photons whose direction has a smaller cosine are dropped, because what they bring is divided by the cosine: one
    // would count a thousand times. The other techniques find such light instead, but for that of point lights.
    constexpr float least_photon_cosine = 1e-3f;
    if (!photons || bsdf.bsdf().is_delta()) return 0.0f;
    const float cosine = photon_cosine(surface, bsdf.frame(), wi);
    if (!(cosine > least_photon_cosine)) return 0.0f;
    return per_line_density_across(photons, scene, wi.z < 0.0f ? surface.far_side->phase : surface.near_side.phase) *
           cosine;
}

/// The same of a direction that leads on from a rough interface, if photons count at an earlier place: `before` is that
/// of the direction in which the path left the earlier place, over the density with which the path chose it.
inline float per_line_density_beyond(float before, const Scene& scene, const Surface& surface, const GuidedBsdf& bsdf,
                                     const glm::vec3& wi) {
    // A bump may send the path into the surface once more, where no photon comes from.
    if (!surface.far_side && !(photon_cosine(surface, bsdf.frame(), wi) > 0.0f)) return 0.0f;
    const Surface::Side& left_to = wi.z < 0 ? *surface.far_side : surface.near_side;
    return before * rough_factor(bsdf.bsdf().reverse_pdf(bsdf.wo(), wi), clear_at(scene, left_to.phase).ior, wi.z,
                                 clear_at(scene, surface.near_side.phase).ior, bsdf.wo().z);
}

}  // namespace phasetree::tracer
