// The density with which photons find the directions at a point that gathers them (path.hpp), except for the line
// density, which is known only at the light's end of a chain.
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
/// the chain. `per_line_density` is N π r² n² cos θ on a surface and N π r² n² F in a medium (path.hpp). It is
/// multiplied by R of each rough interface on the way, and divided by the pdfs with which the path chose its directions
/// before (rough_chain.hpp).
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

/// The cosine by which photons from a local direction are spread over the surface, relative to the geometric normal.
inline float photon_cosine(const Surface& surface, const Frame& frame, const glm::vec3& wi) {
    if (surface.far_side) return std::abs(wi.z);
    if (surface.normal == surface.geometric_normal) return wi.z;
    return wi.z > 0.0f ? glm::dot(frame.to_world(wi), surface.geometric_normal) : 0.0f;
}

/// N π r² n². In a dispersive phase, n is that of the d line: all techniques use the same factor, so their weights
/// still sum to 1. Requires photons.
inline float per_line_density_across(const Photons& photons, const Scene& scene, Phase phase) {
    const float ior = clear_at(scene, phase).ior;
    return photons.map->expected() * ior * ior;
}

/// PhotonDensity::per_line_density of a direction at a surface that gathers photons; 0 if they do not count in it.
inline float per_line_density_at(const Photons& photons, const Scene& scene, const Surface& surface,
                                 const GuidedBsdf& bsdf, const glm::vec3& wi) {
    // Photons with a smaller cosine are dropped, because their contribution is divided by the cosine and one of them
    // would count a thousand times. The other techniques find such light instead, except for that of point lights.
    constexpr float least_photon_cosine = 1e-3f;
    if (!photons || bsdf.bsdf().is_delta()) return 0.0f;
    const float cosine = photon_cosine(surface, bsdf.frame(), wi);
    if (!(cosine > least_photon_cosine)) return 0.0f;
    return per_line_density_across(photons, scene, wi.z < 0.0f ? surface.far_side->phase : surface.near_side.phase) *
           cosine;
}

/// As above, for a direction that continues from a rough interface, if photons count at an earlier vertex. `before` is
/// that of the direction in which the path left the earlier vertex, over the pdf with which the path chose it.
inline float per_line_density_beyond(float before, const Scene& scene, const Surface& surface, const GuidedBsdf& bsdf,
                                     const glm::vec3& wi) {
    // A bump may send the path into the surface again, where no photon comes from.
    if (!surface.far_side && !(photon_cosine(surface, bsdf.frame(), wi) > 0.0f)) return 0.0f;
    const Surface::Side& left_to = wi.z < 0 ? *surface.far_side : surface.near_side;
    return before * rough_factor(bsdf.bsdf().reverse_pdf(bsdf.wo(), wi), clear_at(scene, left_to.phase).ior, wi.z,
                                 clear_at(scene, surface.near_side.phase).ior, bsdf.wo().z);
}

}  // namespace phasetree::tracer
