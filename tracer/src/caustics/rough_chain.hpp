// Chains with rough interfaces: how the densities of photons compare with those of a path's own techniques.
//
// Elsewhere a chain ends at a rough interface because a path is scattered there. Photons continue, so here a chain
// leads from a point x that gathers photons through all interfaces, smooth and rough, to a lamp. x is on an opaque
// surface or in a medium, or on a rough interface to which no chain leads from such a point. Let one of the interfaces
// be rough, at a point y. ω is the direction at y on the side of x, and ω' that on the side of the lamp; n and n' are
// the indices there, θ and θ' the angles to the normal. ω_x, n_x and θ_x belong to x, and n_l is the index around the
// lamp. Three techniques find the chain, with these densities of (ω_x, ω') in 1/sr²:
//   directions:   ω_x by the BSDF at x, ω' by that at y,         p_x(ω_x) p_y(ω' | ω)
//   shadow rays:  ω_x by the BSDF at x, ω' by a shadow ray at y, p_x(ω_x) p_lights(ω' | y)
//   photons:      a line at the lamp, ω by the BSDF at y as it is seen from the lamp,
//                 N π r² n_x² cos θ_x · (p(line)/n_l²) · R,   R = p_y*(ω | ω') n'² cos θ' / (n² cos θ).
// p_y* is the pdf with which the interface, met from the lamp's side, scatters to ω. The factors before R are those of
// path.hpp for chains without y. R follows from the étendue, n² dA cos θ dω: it is the same all along the way from x to
// y, and n'² dA cos θ' dω' is the same all along that from y to the lamp. Each further rough interface multiplies the
// first two densities by its p_y, and that of photons by its R.
//
// A point light has a density q of directions instead of p(line)/n_l². If a photon of it reaches its first rough
// interface without refraction, at the distance d from the light, q/(n'² d²) replaces that term, because area across
// the line is d² times solid angle at the light. If it was refracted before, no other technique finds its light.
#pragma once

#include <cmath>
#include <optional>

namespace phasetree::tracer {

/// The density with which a camera path that has chosen its direction at x finds the rest of the chain, over that of
/// the photon. Of the photon's density, only R is included, so if BSDFs choose all directions, the quotient is the
/// product of all p_y/R. Quotients are stored because products of many densities overflow.
struct DensityQuotients {
    /// If BSDFs choose all directions: 1 without rough interfaces, and 0 for a point light, which no direction meets.
    float by_directions = 1;
    /// If a shadow ray chooses the direction at the rough interface nearest the lamp: p_lights/R there, and p_y/R of
    /// the others. nullopt without rough interfaces, when shadow rays start at x. It is 0 for a point light whose
    /// photon was refracted before any rough interface scattered it.
    std::optional<float> by_shadow_rays{};
};

/// Returns R. The photon is scattered to the path's side with `pdf`, per steradian. The indices and cosines are those
/// on the lamp's side and on the path's; for a reflection, both indices are the same.
inline float rough_factor(float pdf, float lamp_ior, float lamp_cosine, float path_ior, float path_cosine) {
    return pdf * (lamp_ior * lamp_ior * std::abs(lamp_cosine)) / (path_ior * path_ior * std::abs(path_cosine));
}

/// n'² d², which divides the density of a point light's directions at an unrefracted distance from it.
inline float squared_optical_distance(float ior, float distance) {
    return (ior * distance) * (ior * distance);
}

}  // namespace phasetree::tracer
